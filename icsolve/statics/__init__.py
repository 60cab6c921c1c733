"""Free bodies: the equilibrium of every link gives the force of each link on each other at every joint.

The same equations give the unknown loads a second time, apart from power, and carry friction.
"""
