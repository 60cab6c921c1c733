"""Run time against error, and the stress catalogue: what `icsolve bench` runs."""
