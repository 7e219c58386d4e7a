"""The band of a result from the uncertainty of inputs and laws, with the share of each input."""
