"""What can be asked of a workspace."""
