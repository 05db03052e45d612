// The physics and the rules of the game: flippers, a plunger, points and three balls, on the table of `table.toml`.
// `examples/pinball/src/table.rs` does the same in the same order, so the same keys lead to the same bits. Nothing here
// needs Unity.

using System;
using System.Collections.Generic;
using Carom;

namespace Pinball
{
    /// <summary>What a collider is in the game.</summary>
    public enum Role { Flipper, Bumper, Slingshot, Target, Drain, Wall }

    /// <summary>Keys that are down.</summary>
    public struct Keys
    {
        public bool Left, Right, Plunger;
    }

    /// <summary>Something to hear: the number in `table.toml` of the collider that the ball touches, and the impulse
    /// [N s], 0 for targets and the drain.</summary>
    public struct Sound
    {
        public int Collider;
        public double Impulse;
    }

    /// <summary>A game on a table.</summary>
    public sealed class Table : IDisposable
    {
        /// <summary>Length of a frame of the physics [s].</summary>
        public const double Frame = 1.0 / 120.0;

        // Balls of a game.
        const int BallsOfGame = 3;
        // Where a ball waits for the plunger [m].
        static readonly Double3 Start = new Double3(0.28, 0.06, 0.0);
        // Frames that the game can go back.
        const int PastFrames = 360;
        /// <summary>Half the length of a flipper between the centres of its ends [m].</summary>
        public const double HalfFlipper = 0.045;
        /// <summary>The axis of the right flipper [m].</summary>
        public const double PivotX = 0.115, PivotY = 0.14;
        // A flipper rises by as many steps, one in a frame, from as far below.
        const int Steps = 4;
        // Frames in which the plunger is drawn back whole.
        const int FullPull = 64;
        // Impulse of the plunger when it is drawn back whole [N s].
        const double Launch = 0.2;
        // Slower impacts neither sound nor score [m/s].
        const double Silent = 0.05;

        // What a game needs to go on, besides the world.
        struct State
        {
            public int Score, Balls, Pull;
            public Flipper Left, Right;
        }

        struct Flipper
        {
            // Steps above the middle.
            public int Step;
            // Whether it has turned in the last frame, so that it has to be stopped.
            public bool Turned;
        }

        sealed class Moment
        {
            public CaromSnapshot World;
            public State State;
        }

        readonly CaromWorld world;
        readonly ulong ball;
        readonly ulong[] colliders;
        // The last frames, the oldest overwritten first; frames since the start, and frames that can be gone back.
        readonly List<Moment> past = new List<Moment>();
        int frames, kept;
        State state;

        /// <summary>Makes a table from the text of `table.toml`, with a ball before the plunger.</summary>
        public Table(string toml)
        {
            world = CaromWorld.FromToml(toml);
            ball = world.Ids(CaromList.Spheres)[0];
            colliders = world.Ids(CaromList.Colliders);
            var flipper = new Flipper { Step = -Steps, Turned = true };
            state = new State { Balls = BallsOfGame, Left = flipper, Right = flipper };
        }

        public void Dispose()
        {
            foreach (var moment in past) moment.World.Dispose();
            world.Dispose();
        }

        public CaromWorld World { get { return world; } }

        public int Score { get { return state.Score; } }

        /// <summary>Balls left, with the one on the table; 0 after a game.</summary>
        public int Balls { get { return state.Balls; } }

        /// <summary>The part of its way that the plunger is drawn back.</summary>
        public double Pull { get { return (double)state.Pull / FullPull; } }

        /// <summary>Whether the ball lies before the plunger.</summary>
        public bool IsBallWaiting
        {
            get
            {
                var place = world.Sphere(ball).Position;
                return place.X > Start.X - 0.02 && place.Y < Start.Y + 0.01;
            }
        }

        /// <summary>Returns the role of the collider with this number in `table.toml`.</summary>
        public static Role RoleOf(int number)
        {
            if (number < 2) return Role.Flipper;
            if (number < 5) return Role.Bumper;
            if (number < 7) return Role.Slingshot;
            if (number < 10) return Role.Target;
            return number == 10 ? Role.Drain : Role.Wall;
        }

        /// <summary>Returns a flipper in its present pose: 0 is the left one, 1 the right one.</summary>
        public CaromCollider FlipperPose(int number) { return world.Collider(colliders[number]); }

        /// <summary>Advances by a frame. Returns what there is to hear.</summary>
        public List<Sound> Step(Keys keys)
        {
            Remember();
            MoveFlipper(0, -1.0, ref state.Left, keys.Left);
            MoveFlipper(1, 1.0, ref state.Right, keys.Right);
            MovePlunger(keys.Plunger);
            world.Step(Frame);
            var sounds = Sounds();
            foreach (var sound in sounds)
            {
                var role = RoleOf(sound.Collider);
                if (role == Role.Drain) LoseBall();
                else state.Score += Points(role);
            }
            return sounds;
        }

        static int Points(Role role)
        {
            switch (role)
            {
                case Role.Bumper: return 100;
                case Role.Slingshot: return 10;
                case Role.Target: return 500;
                default: return 0;
            }
        }

        // Turns a flipper by a step; it strikes with the velocity that brings it there in the frame. One that rests is
        // left alone: then its frames are cheaper.
        void MoveFlipper(int number, double side, ref Flipper flipper, bool isRaised)
        {
            int next = isRaised ? Math.Min(Steps, flipper.Step + 1) : Math.Max(-Steps, flipper.Step - 1);
            bool turns = next != flipper.Step;
            if (turns || flipper.Turned)
            {
                Double3 position;
                Double4 rotation;
                PoseOfFlipper(side, next, out position, out rotation);
                world.SetNextPose(colliders[number], position, rotation, Frame);
            }
            flipper.Step = next;
            flipper.Turned = turns;
        }

        // Draws the plunger back, or lets it strike the ball that lies before it. After the last ball, that begins a new
        // game.
        void MovePlunger(bool isDrawn)
        {
            if (isDrawn)
            {
                state.Pull = Math.Min(FullPull, state.Pull + 1);
                return;
            }
            int pull = state.Pull;
            state.Pull = 0;
            if (pull == 0 || !IsBallWaiting) return;
            if (state.Balls == 0)
            {
                state.Balls = BallsOfGame;
                state.Score = 0;
            }
            world.ApplyImpulse(ball, new Double3(0.0, Launch * ((double)pull / FullPull), 0.0));
        }

        // Lists what the ball hits, then the triggers that it enters.
        List<Sound> Sounds()
        {
            var sounds = new List<Sound>();
            foreach (var impact in world.Impacts())
            {
                if (impact.Bodies.Body1IsCollider == 0 || impact.ApproachSpeed <= Silent) continue;
                int number = Array.IndexOf(colliders, impact.Bodies.Body1);
                sounds.Add(new Sound { Collider = number, Impulse = impact.Impulse });
            }
            foreach (var entry in world.SensorEvents())
            {
                if (entry.Enters == 1) sounds.Add(new Sound { Collider = Array.IndexOf(colliders, entry.Collider) });
            }
            return sounds;
        }

        // Puts the next ball before the plunger; after the last one, it waits for a new game.
        void LoseBall()
        {
            state.Balls -= 1;
            state.Pull = 0;
            var next = world.Sphere(ball);
            next.Position = Start;
            next.Velocity = new Double3();
            world.SetSphere(ball, next);
        }

        /// <summary>Goes back by some frames, as far as they are kept.</summary>
        public void GoBack(int wanted)
        {
            int back = Math.Min(wanted, kept);
            if (back == 0) return;
            frames -= back;
            kept -= back;
            var moment = past[frames % PastFrames];
            world.Restore(moment.World);
            state = moment.State;
        }

        // Keeps the present state, in the memory of the oldest one.
        void Remember()
        {
            int place = frames % PastFrames;
            if (place == past.Count) past.Add(new Moment { World = world.Snapshot() });
            else world.SnapshotInto(past[place].World);
            past[place].State = state;
            frames += 1;
            kept = Math.Min(PastFrames, kept + 1);
        }

        // The pose of a flipper on the side -1 or 1, `step` steps above the middle. It turns about its outer end; a
        // capsule lies along its own y.
        //
        // A step is one of the tangent of half the angle, from which cosine and sine follow by exact divisions: the same
        // bits in every language, which functions for angles do not promise.
        static void PoseOfFlipper(double side, int step, out Double3 position, out Double4 rotation)
        {
            double tangent = step / 16.0;
            double square = 1.0 + tangent * tangent;
            double cosine = (1.0 - tangent * tangent) / square, sine = 2.0 * tangent / square;
            position = new Double3(side * (PivotX - HalfFlipper * cosine), PivotY + HalfFlipper * sine, 0.0);
            rotation = new Double4(0.0, 0.0, side * (1.0 - tangent), 1.0 + tangent);
        }
    }
}
