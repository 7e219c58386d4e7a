"""The static page: the model in the browser, without a server and without Python."""
