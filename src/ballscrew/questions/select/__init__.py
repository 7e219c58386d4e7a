"""Selection: screws of catalogues against a need, each judged by the full model and all checks, and ranked."""
