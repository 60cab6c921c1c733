"""Coulomb friction in joints and ropes: what rubs, the equations of the rubs, their solutions, and limits."""
