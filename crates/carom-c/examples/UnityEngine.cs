// What `CaromWorld.cs` and the pinball need of Unity, to compile and test their parts for Unity without it. Nothing is
// drawn and nothing sounds; a program sets the keys and the time.

using System;
using System.Collections.Generic;

namespace UnityEngine
{
    public struct Vector3
    {
        public float x, y, z;

        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }

        public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }

        public static Vector3 operator -(Vector3 a, Vector3 b) { return new Vector3(a.x - b.x, a.y - b.y, a.z - b.z); }

        public static Vector3 Lerp(Vector3 a, Vector3 b, float part)
        {
            return new Vector3(a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), a.z + part * (b.z - a.z));
        }

        public static float Distance(Vector3 a, Vector3 b)
        {
            float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
            return (float)Math.Sqrt(x * x + y * y + z * z);
        }
    }

    public struct Quaternion
    {
        public float x, y, z, w;

        public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }

        public static Vector3 operator *(Quaternion q, Vector3 v)
        {
            float x = 2.0f * (q.y * v.z - q.z * v.y), y = 2.0f * (q.z * v.x - q.x * v.z);
            float z = 2.0f * (q.x * v.y - q.y * v.x);
            return new Vector3(v.x + q.w * x + q.y * z - q.z * y, v.y + q.w * y + q.z * x - q.x * z,
                v.z + q.w * z + q.x * y - q.y * x);
        }

        public static Quaternion Inverse(Quaternion q) { return new Quaternion(-q.x, -q.y, -q.z, q.w); }

        // Unity normalizes the result.
        public static Quaternion Slerp(Quaternion a, Quaternion b, float part)
        {
            return part < 0.5f ? a : b;
        }
    }

    public struct Color
    {
        public static readonly Color white = new Color();

        public static Color Lerp(Color a, Color b, float part) { return part < 0.5f ? a : b; }
    }

    public struct Rect
    {
        public Rect(float x, float y, float width, float height) { }
    }

    public static class Mathf
    {
        public const float PI = (float)Math.PI;

        public static float Clamp01(float value) { return Math.Max(0.0f, Math.Min(1.0f, value)); }
        public static float Pow(float value, float power) { return (float)Math.Pow(value, power); }
        public static float Sin(float value) { return (float)Math.Sin(value); }
        public static float Exp(float value) { return (float)Math.Exp(value); }
    }

    public class MonoBehaviour { }

    public sealed class Transform
    {
        public Vector3 localPosition, lossyScale = new Vector3(1.0f, 1.0f, 1.0f);
        public Quaternion localRotation = new Quaternion(0.0f, 0.0f, 0.0f, 1.0f);

        // No transform has a parent here.
        public Vector3 position { get { return localPosition; } }
        public Quaternion rotation { get { return localRotation; } }

        public Vector3 TransformPoint(Vector3 point)
        {
            point = new Vector3(point.x * lossyScale.x, point.y * lossyScale.y, point.z * lossyScale.z);
            return localPosition + localRotation * point;
        }
    }

    public sealed class Mesh
    {
        public Vector3[] vertices;
        public int[] triangles;
    }

    public sealed class MeshCollider
    {
        public Mesh sharedMesh;
        public readonly Transform transform = new Transform();
    }

    public sealed class TerrainData
    {
        public Vector3 size;
        public int heightmapResolution;
        // Parts of size.y by z and x, as Unity has them.
        public float[,] Parts;

        public float[,] GetHeights(int x, int y, int width, int height) { return Parts; }
    }

    public sealed class Terrain
    {
        public TerrainData terrainData;
        public readonly Transform transform = new Transform();
    }

    public sealed class Material
    {
        public Color color;
    }

    public sealed class Renderer
    {
        public readonly Material material = new Material();
    }

    public sealed class AudioClip
    {
        public static AudioClip Create(string name, int samples, int channels, int frequency, bool stream)
        {
            return new AudioClip();
        }

        public bool SetData(float[] samples, int offset) { return true; }
    }

    public sealed class AudioSource
    {
        // How many sounds were played.
        public int Played;

        public void PlayOneShot(AudioClip clip, float loudness) { Played += 1; }
    }

    public enum KeyCode { Backspace, Space, LeftArrow, RightArrow, DownArrow, A, D }

    public static class Input
    {
        // Keys that are down.
        public static readonly HashSet<KeyCode> Down = new HashSet<KeyCode>();

        public static bool GetKey(KeyCode key) { return Down.Contains(key); }
    }

    public static class Time
    {
        public static float time, fixedTime, fixedDeltaTime = 0.02f, deltaTime = 0.02f;
    }

    public static class Application
    {
        public static string streamingAssetsPath;
    }

    public static class Screen
    {
        public static int width = 640;
    }

    public enum TextAnchor { UpperCenter }

    public sealed class GUIStyleState
    {
        public Color textColor;
    }

    public sealed class GUIStyle
    {
        public int fontSize;
        public TextAnchor alignment;
        public readonly GUIStyleState normal = new GUIStyleState();
    }

    public static class GUI
    {
        // The last text.
        public static string Shown;

        public static void Label(Rect place, string text, GUIStyle style) { Shown = text; }
    }
}
