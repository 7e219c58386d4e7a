"""The application in the browser: a JSON API and the page that uses it. Needs the extra ``web``."""
