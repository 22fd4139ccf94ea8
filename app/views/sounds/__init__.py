"""What an attempt lets be heard."""
