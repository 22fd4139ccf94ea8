"""Parts of the study `pantograph`: maps over the workspace, and their pictures."""
