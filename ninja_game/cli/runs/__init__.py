"""Commands about runs: verify, trace, measure, search."""
