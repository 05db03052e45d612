//! The maze game: its rules, mazes, and a player that finds the way. No drawing.
