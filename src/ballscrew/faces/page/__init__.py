"""The page: one document, which a server of this program answers, or the model in the browser alone, without Python."""
