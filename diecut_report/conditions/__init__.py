"""Arithmetic and conditions between quantities: one language, read by one grammar into one tree, answered by NumPy and by DuckDB.

`words` splits a text, `grammar` writes its words as Python and has Python parse it, `reading` and `parts` judge what it says and make
the `tree`; `numpy_emitter` computes and holds the tree against arrays, `arithmetic` reads the expressions of a configuration. Constraints
of a study and questions to stored variants (which are written as SQL) stand in `study/conditions`.
"""
