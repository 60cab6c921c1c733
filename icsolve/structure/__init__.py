"""Topology, groups of links and the plan of a scene: combinatorics alone."""
