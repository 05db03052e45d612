//! The scenes that are part of Carom: the files of `scenes/`, embedded.

macro_rules! embed {
    ($($file:literal),* $(,)?) => {
        /// Name and text of each built-in scene file.
        pub const FILES: &[(&str, &str)] =
            &[$(($file, include_str!(concat!("../../../scenes/", $file)))),*];
    };
}

embed!(
    "simtest1.toml",
    "simtest2.toml",
    "simtest3.toml",
    "simtest4.toml",
    "simtest5.toml",
    "simtest6.toml",
    "maze.toml",
    "tutorial1.toml",
    "tutorial2.toml",
    "tutorial3.toml",
    "tutorial4.toml",
    "pour.toml",
    "billiards.toml",
    "draw-shot.toml",
    "masse.toml",
    "galton.toml",
    "granular-column.toml",
    "hourglass.toml",
    "avalanche.toml",
    "chain-reaction.toml",
);
