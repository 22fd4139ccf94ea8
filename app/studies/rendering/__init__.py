"""Parts of the study `stability`: a reduction to one degree of freedom, and the whole device."""
