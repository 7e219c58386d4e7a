"""Response models of the API, made from the annotations of the parts that its answers consist of."""
