"""What an arm reaches, pose by pose: maps of millions of them, what they tell, and where to put the base."""
