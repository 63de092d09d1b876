"""The attack: shapes and options drawn at random, every fit judged by the outside checker."""
