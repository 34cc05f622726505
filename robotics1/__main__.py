"""The command `robotics1` as `python -m robotics1`, where its folder is not on the path."""

from robotics1.cli import main

if __name__ == "__main__":
    main()
