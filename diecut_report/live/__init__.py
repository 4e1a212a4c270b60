"""A page in the browser beside the editor: a configuration calculated again at each change of the file or of a number on the page."""
