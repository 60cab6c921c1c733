"""The construction behind an answer: what is known of a scene, the order in which its centres are found,
and how the speed of one link follows from another's. Explanations, drawings and pages all read it."""
