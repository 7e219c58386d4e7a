"""Parts: frozen dataclasses that bind parameters to equations. No iteration here."""
