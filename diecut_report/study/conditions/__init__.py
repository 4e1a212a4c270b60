"""Where conditions stand in a study: its constraints (`constraints`, `terms`) and questions to stored variants (`where`, `sql_emitter`).

Their language is that of `diecut_report.conditions`.
"""
