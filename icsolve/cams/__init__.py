"""Cam profiles: where the profile of one link touches the follower of another, and along which normal.

Only a case with a `profile` section comes here; nothing of it is imported otherwise.
"""
