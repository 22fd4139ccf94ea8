"""The page where one reads and works: panes, layouts, panels."""
