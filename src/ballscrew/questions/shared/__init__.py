"""Parts that several questions share: rows of cases, tables on the terminal and in files, the style of charts."""
