"""What the answers look like: animated pages and plots."""
