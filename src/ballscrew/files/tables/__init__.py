"""Tables that people write: spreadsheets and CSV, headings, numbers, rows."""
