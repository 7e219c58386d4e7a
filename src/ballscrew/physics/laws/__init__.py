"""Laws in their slots: what a friction model is put together of, one file a slot."""
