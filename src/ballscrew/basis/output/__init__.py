"""Parts that all output needs: the sheet of an answer, text of JSON, wrapped lines, the bibliography."""
