// The pinball of examples/pinball-unity without Unity: the keys of ten seconds, pressed in the script of the scene, lead
// to the state hash and the score of the game in Rust.
//
//     Pinball.exe FOLDER_OF_TABLE_TOML "HASH SCORE"

using System;
using System.Reflection;
using Pinball;
using UnityEngine;

static class PinballTest
{
    const int Frames = 1200;

    // Calls a method as Unity does: by its name.
    static void Call(PinballGame game, string name)
    {
        typeof(PinballGame).GetMethod(name, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(game, null);
    }

    // Presses the keys of crates/carom-scene/tests/pinball_example.rs.
    static void Press(int frame)
    {
        Input.Down.Clear();
        if (frame / 20 % 2 == 0) Input.Down.Add(KeyCode.LeftArrow);
        if (frame / 27 % 2 == 0) Input.Down.Add(KeyCode.D);
        if (frame % 90 < 60) Input.Down.Add(KeyCode.Space);
    }

    static void Play(PinballGame game, int from)
    {
        for (int frame = from; frame < Frames; frame++)
        {
            Press(frame);
            Call(game, "FixedUpdate");
            Time.time = Time.fixedTime + Time.fixedDeltaTime;
            Call(game, "Update");
            Call(game, "OnGUI");
        }
    }

    static string Reached(PinballGame game)
    {
        return string.Format("{0:x16} {1}", game.Table.World.StateHash, game.Table.Score);
    }

    static void Expect(bool holds, string what)
    {
        if (!holds) throw new Exception("it does not hold that " + what);
    }

    static void Main(string[] arguments)
    {
        Application.streamingAssetsPath = arguments[0];
        var game = new PinballGame
        {
            ball = new Transform(), plunger = new Transform(), speaker = new AudioSource(),
            flippers = new[] { new Transform(), new Transform() }, lamps = new Renderer[8],
        };
        for (int i = 0; i < game.lamps.Length; i++) game.lamps[i] = new Renderer();
        Call(game, "Awake");
        Play(game, 0);
        Console.WriteLine("pinball: {0}", Reached(game));
        Expect(Reached(game) == arguments[1], "the game reaches " + arguments[1]);
        Expect(GUI.Shown.StartsWith(game.Table.Score + "\n"), "the score is shown");
        Expect(game.speaker.Played > 10, "impacts sound");
        var place = game.Table.World.Sphere(0).Position;
        Expect(Math.Abs(game.ball.localPosition.x - place.X) < 1e-6, "the ball is drawn where it is");
        for (int i = 0; i < 2; i++)
        {
            var flipper = game.Table.FlipperPose(i).Position;
            var drawn = game.flippers[i].localPosition;
            // Unity's numbers have 24 bits.
            bool isThere = Math.Abs(drawn.x - flipper.X) < 1e-6 && Math.Abs(drawn.y - flipper.Y) < 1e-6;
            Expect(isThere, "a flipper turns about its axis");
        }
        game.Table.GoBack(300);
        Play(game, Frames - 300);
        Expect(Reached(game) == arguments[1], "a game that goes back and repeats its keys ends in the same bits");
        Call(game, "OnDestroy");
    }
}
