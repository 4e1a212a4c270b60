"""Makes the sources of the documentation site: from the documents, the plugins' declarations and the program itself.

``python -m tools.site FOLDER`` writes them, Sphinx sets them (``scripts/site.sh``), ``tools.site.built_links`` judges what it set.
"""
