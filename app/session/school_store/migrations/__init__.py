"""Schema of the school's store, step by step (Alembic)."""
