"""Joins and meets, twists and wrenches, and what each kind of joint leaves free, on homogeneous triples."""
