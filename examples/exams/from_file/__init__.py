"""An exam written as one TOML file: its robots, tasks, data and published values, and the worked page of it."""
