"""Models fitted to measured torques: the problem, the robust estimator, what the data identify, the next test."""
