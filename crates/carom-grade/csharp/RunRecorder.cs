// Records the balls of a running scene of Unity, a row for each ball after each fixed frame: the table that `carom grade` reads.

using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using UnityEngine;

[DefaultExecutionOrder(10000)]                      // after the simulation of the same frame
public class RunRecorder : MonoBehaviour
{
    public string file = "simtest1.csv";
    public string ballName = "Sphere(Clone)";
    public int frames = 600;                        // 12 s

    readonly Dictionary<Transform, int> numbers = new Dictionary<Transform, int>();
    StreamWriter table;
    int frame;

    void Start()
    {
        table = new StreamWriter(file);
        table.WriteLine("t,ball,x,y,z");
    }

    void FixedUpdate()
    {
        if (table == null || ++frame > frames) return;
        var balls = FindObjectsOfType<Transform>().Where(it => it.name == ballName);
        foreach (var ball in balls.OrderBy(it => numbers.TryGetValue(it, out int n) ? n : int.MaxValue))
        {
            if (!numbers.ContainsKey(ball)) numbers[ball] = numbers.Count;
            Vector3 p = ball.position;
            table.WriteLine(string.Format(CultureInfo.InvariantCulture, "{0:R},{1},{2:R},{3:R},{4:R}",
                frame * (double)Time.fixedDeltaTime, numbers[ball], p.x, p.y, p.z));
        }
    }

    void OnDestroy() { table?.Dispose(); }
}
