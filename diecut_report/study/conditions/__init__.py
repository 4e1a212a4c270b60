"""Conditions between quantities: one language, read by one grammar into one tree, answered by NumPy and by DuckDB.

`words` splits a text, `grammar` writes its words as Python and has Python parse it, `reading` and `parts` judge what it says and make
the `tree`; `numpy_emitter` holds the tree against arrays, `sql_emitter` writes it as SQL with parameters. Constraints of a study
(`constraints`, `terms`) and questions to stored variants (`where`) are the two places where conditions stand.
"""
