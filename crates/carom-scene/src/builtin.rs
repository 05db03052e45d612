//! Built-in scenes: the files of the folder `scenes/`, embedded, in the order of listings.

macro_rules! embed {
    ($($file:literal),* $(,)?) => {
        /// Name and text of each built-in scene file.
        pub const FILES: &[(&str, &str)] =
            &[$(($file, include_str!(concat!("../scenes/", $file)))),*];
    };
}

embed!(
    "billiards.toml",
    "nine-ball.toml",
    "pinball.toml",
    "pour.toml",
    "cradle.toml",
    "cradle-on-threads.toml",
    "spring-chain.toml",
    "planets.toml",
    "fountain.toml",
    "galton.toml",
    "gas.toml",
    "bounce.toml",
    "chain-reaction.toml",
    "hourglass.toml",
    "avalanche.toml",
    "granular-column.toml",
    "marble-run.toml",
    "bowl.toml",
    "drum.toml",
    "terrain.toml",
    "vibrated-plate.toml",
    "gates.toml",
    "fermi.toml",
    "bank-shot.toml",
    "butterfly.toml",
    "draw-shot.toml",
    "masse.toml",
    "maze.toml",
    "simtest1.toml",
    "simtest2.toml",
    "simtest3.toml",
    "simtest4.toml",
    "simtest5.toml",
    "simtest6.toml",
    "tutorial1.toml",
    "tutorial2.toml",
    "tutorial3.toml",
    "tutorial4.toml",
);
