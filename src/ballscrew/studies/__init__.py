"""Questions about a case, computed: one module per question, a case in, a frozen value out."""
