"""A careless user: the real window driven at random, and checked after every action."""
