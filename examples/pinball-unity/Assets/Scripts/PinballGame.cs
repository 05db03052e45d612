// Pinball in Unity. Copy into Assets, as docs/games.md says: crates/carom-c/csharp/CaromWorld.cs; the library of the C
// interface, into Assets/Plugins; examples/pinball/table.toml, into Assets/StreamingAssets. Then open Assets/Pinball.unity.
//
// The objects of the scene have the places of the colliders in `table.toml`; Carom moves the ball and the flippers, and
// Unity draws and sounds.

using System.Collections.Generic;
using System.IO;
using Carom;
using UnityEngine;

namespace Pinball
{
    /// <summary>Plays a game by the keys: arrows or A and D for the flippers, Space for the plunger, Backspace to go
    /// back.</summary>
    public sealed class PinballGame : MonoBehaviour
    {
        public Transform ball, plunger;
        public Transform[] flippers;
        /// <summary>What lights when it is hit: the colliders from number 2 on.</summary>
        public Renderer[] lamps;
        public AudioSource speaker;

        const int FirstLamp = 2;
        // The way that the plunger is drawn back [m].
        const float PlungerWay = 0.035f;
        // An impulse that sounds at full loudness [N s].
        const double Loud = 0.15;
        // A light loses half its brightness in this time [s].
        const float HalfLife = 0.09f;

        readonly Vector3[] positions = new Vector3[1];
        Vector3 before, after, plungerAtRest;
        readonly Quaternion[] flippersBefore = new Quaternion[2], flippersAfter = new Quaternion[2];
        Dictionary<Role, AudioClip> clips;
        Color[] colors;
        float[] brightness;
        GUIStyle style;

        /// <summary>The game.</summary>
        public Table Table { get; private set; }

        void Awake()
        {
            Table = new Table(File.ReadAllText(Path.Combine(Application.streamingAssetsPath, "table.toml")));
            Time.fixedDeltaTime = (float)Table.Frame;
            plungerAtRest = plunger.localPosition;
            brightness = new float[lamps.Length];
            colors = new Color[lamps.Length];
            for (int i = 0; i < lamps.Length; i++) colors[i] = lamps[i].material.color;
            clips = new Dictionary<Role, AudioClip>
            {
                { Role.Bumper, Tone("bumper", 520.0f, 0.18f) },
                { Role.Slingshot, Tone("slingshot", 330.0f, 0.14f) },
                { Role.Target, Tone("target", 880.0f, 0.5f) },
                { Role.Drain, Tone("drain", 110.0f, 0.9f) },
                { Role.Flipper, Tone("flipper", 180.0f, 0.06f) },
                { Role.Wall, Tone("wall", 240.0f, 0.05f) },
            };
            ReadPlaces();
            before = after;
        }

        void OnDestroy() { Table.Dispose(); }

        // Unity calls this once for each frame of the physics.
        void FixedUpdate()
        {
            if (Input.GetKey(KeyCode.Backspace)) Table.GoBack(3);
            ReadPlaces();
            before = after;
            flippersAfter.CopyTo(flippersBefore, 0);
            var keys = new Keys
            {
                Left = Input.GetKey(KeyCode.LeftArrow) || Input.GetKey(KeyCode.A),
                Right = Input.GetKey(KeyCode.RightArrow) || Input.GetKey(KeyCode.D),
                Plunger = Input.GetKey(KeyCode.Space) || Input.GetKey(KeyCode.DownArrow),
            };
            foreach (var sound in Table.Step(keys)) Notice(sound);
            ReadPlaces();
            // A new ball does not fly in from the drain.
            if (Vector3.Distance(before, after) > 0.1f) before = after;
        }

        // Unity calls this once for each picture, which shows the places between two frames of the physics.
        void Update()
        {
            float part = Mathf.Clamp01((Time.time - Time.fixedTime) / Time.fixedDeltaTime);
            ball.localPosition = Vector3.Lerp(before, after, part);
            for (int i = 0; i < flippers.Length; i++)
            {
                flippers[i].localRotation = Quaternion.Slerp(flippersBefore[i], flippersAfter[i], part);
                flippers[i].localPosition = CenterOfFlipper(i);
            }
            plunger.localPosition = plungerAtRest + new Vector3(0.0f, -PlungerWay * (float)Table.Pull, 0.0f);
            float left = Mathf.Pow(0.5f, Time.deltaTime / HalfLife);
            for (int i = 0; i < lamps.Length; i++)
            {
                brightness[i] *= left;
                lamps[i].material.color = Color.Lerp(colors[i], Color.white, brightness[i]);
            }
        }

        void OnGUI()
        {
            if (style == null)
            {
                style = new GUIStyle { fontSize = 40, alignment = TextAnchor.UpperCenter };
                style.normal.textColor = Color.white;
            }
            string text = Table.Score + "\n" + new string('\u25cf', Table.Balls);
            if (Table.Balls == 0) text += "Game over: hold Space for a new game";
            else if (Table.IsBallWaiting && Table.Pull == 0.0) text += "\nHold Space, and let go";
            GUI.Label(new Rect(0.0f, 10.0f, Screen.width, 160.0f), text, style);
        }

        // Reads where ball and flippers are now, in Unity's coordinates.
        void ReadPlaces()
        {
            Table.World.ReadPositions(positions);
            after = positions[0];
            for (int i = 0; i < flippersAfter.Length; i++)
            {
                flippersAfter[i] = CaromWorld.ToUnity(Table.FlipperPose(i).Rotation);
            }
        }

        // A flipper turns about its outer end: half its length from the axis, along its own y.
        Vector3 CenterOfFlipper(int number)
        {
            float side = number == 0 ? -1.0f : 1.0f;
            var axis = new Vector3(side * (float)Table.PivotX, (float)Table.PivotY, 0.0f);
            return axis + flippers[number].localRotation * new Vector3(0.0f, (float)Table.HalfFlipper, 0.0f);
        }

        // Sounds, and lights what was hit.
        void Notice(Sound sound)
        {
            float loudness = sound.Impulse == 0.0 ? 1.0f : Mathf.Clamp01((float)(sound.Impulse / Loud));
            speaker.PlayOneShot(clips[Table.RoleOf(sound.Collider)], loudness);
            int lamp = sound.Collider - FirstLamp;
            if (lamp >= 0 && lamp < lamps.Length) brightness[lamp] = 1.0f;
        }

        // A tone of a pitch [Hz] that fades away within a time [s].
        static AudioClip Tone(string name, float pitch, float seconds)
        {
            const int Rate = 44100;
            var samples = new float[(int)(seconds * Rate)];
            for (int i = 0; i < samples.Length; i++)
            {
                float time = i / (float)Rate;
                samples[i] = 0.5f * Mathf.Sin(2.0f * Mathf.PI * pitch * time) * Mathf.Exp(-6.0f * time / seconds);
            }
            var clip = AudioClip.Create(name, samples.Length, 1, Rate, false);
            clip.SetData(samples, 0);
            return clip;
        }
    }
}
