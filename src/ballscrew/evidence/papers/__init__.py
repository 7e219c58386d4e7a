"""Papers reproduced."""
