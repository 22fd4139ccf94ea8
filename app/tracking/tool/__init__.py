"""The tool and the trocar in two pictures, and the fulcrum."""
