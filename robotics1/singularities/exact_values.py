"""What `Formulas.at` returns stands beside the numeric answers at one configuration."""

from robotics1.symbolic.tasks.at_configuration import ConfigurationFormulas

__all__ = ["ConfigurationFormulas"]
