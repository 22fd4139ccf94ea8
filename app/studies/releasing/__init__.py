"""Parts of the study `let_go`: the rule before, forces to be had, and needles that are let go."""
