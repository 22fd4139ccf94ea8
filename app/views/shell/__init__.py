"""The window itself: menus, pages, messages, settings, undo."""
