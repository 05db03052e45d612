// Worlds in C#: what a program does with them, checked as it goes.
//
//     mcs Worlds.cs csharp/CaromWorld.cs && LD_LIBRARY_PATH=target/release mono Worlds.exe
//
// With arguments, SCENE=HASH: runs these scenes for ten seconds and compares their state hashes.

using System;
using Carom;
#if UNITY_5_3_OR_NEWER
using UnityEngine;
#endif

static class Worlds
{
    static void Expect(bool holds, string what)
    {
        if (!holds) throw new Exception("it does not hold that " + what);
    }

    static CaromException Refused(Action action)
    {
        try
        {
            action();
        }
        catch (CaromException exception)
        {
            return exception;
        }
        throw new Exception("a call was to be refused");
    }

    static void Bounce()
    {
        using (var world = new CaromWorld())
        {
            world.AddGravity(new Double3(0.0, -10.0, 0.0));
            var floor = world.AddCollider(CaromCollider.Default);
            var ball = CaromSphere.Default;
            ball.Position.Y = 6.0;
            var id = world.AddSphere(ball);
            world.Step(1.5);
            var impacts = world.Impacts();
            Expect(impacts.Length == 1 && impacts[0].Time == 1.0, "it falls 5 m in 1 s");
            Expect(impacts[0].Bodies.Body1 == floor && impacts[0].Bodies.Body2 == id, "it meets the floor");
            Expect(impacts[0].ApproachSpeed == 10.0, "it comes with 10 m/s");
            var totals = world.Totals;
            Expect(Math.Abs(totals.KineticEnergy + totals.PotentialEnergy - 60.0) < 1e-12, "energy is kept");
            Console.WriteLine("it bounces after {0} s", impacts[0].Time);

            var velocities = new Double3[1];
            velocities[0] = new Double3(1.0, 0.0, 0.0);
            world.Write(CaromQuantity.Velocities, velocities);
            var numbers = new double[3];
            world.Read(CaromQuantity.Velocities, numbers);
            Expect(numbers[0] == 1.0 && numbers[1] == 0.0, "what is written is read");

            using (var snapshot = world.Snapshot())
            {
                var bytes = snapshot.ToBytes();
                var before = world.StateHash;
                world.Step(1.0);
                Expect(world.StateHash != before, "a step changes the hash");
                world.Restore(snapshot);
                Expect(world.StateHash == before, "a snapshot is returned to");
                using (var other = new CaromWorld())
                using (var read = CaromSnapshot.FromBytes(bytes))
                {
                    other.Restore(read);
                    Expect(other.StateHash == before, "bytes hold a world");
                }
            }
            Expect(Refused(() => world.Step(double.NaN)).Status == CaromStatus.Invalid, "NaN is refused");
            Expect(Refused(() => world.Sphere(7)).Status == CaromStatus.Unknown, "ids are checked");
            Expect(Refused(() => world.Read(CaromQuantity.Positions, new Double3[2])).Status == CaromStatus.Length,
                "lengths are checked");
            var message = Refused(() => CaromWorld.FromToml("name = \"a\"\nspheres = [{ radus = 1 }]")).Message;
            Expect(message.Contains("scene:2: spheres[0].radus"), "errors name the line: " + message);
            world.RemoveSpheres(id);
            Expect(world.Count == 0 && world.Ids(CaromList.Colliders).Length == 1, "spheres are taken out");
            world.Dispose();
            Expect(Refused(() => world.Step(1.0)).Status == CaromStatus.Handle, "what was disposed of is refused");
        }
    }

    static void Functions()
    {
        using (var world = new CaromWorld())
        {
            var ball = CaromSphere.Default;
            ball.Position.X = 1.0;
            var id = world.AddSphere(ball);
            var spring = world.AddForce(
                (sphere, time) => new Double3(-sphere.Position.X, -sphere.Position.Y, -sphere.Position.Z),
                (sphere, time) => 0.5 * sphere.Position.X * sphere.Position.X);
            GC.Collect();
            for (int i = 0; i < 100; i++) world.Step(Math.PI / 100.0);
            Expect(Math.Abs(world.Sphere(id).Position.X + 1.0) < 1e-3, "a spring takes it to the other side");
            Expect(Math.Abs(world.Totals.KineticEnergy + world.Totals.PotentialEnergy - 0.5) < 1e-3, "energy is kept");
            Console.WriteLine("after half a period: {0}", world.Sphere(id).Position.X.ToString("F4"));
            world.RemoveForce(spring);
            world.AddForce((sphere, time) => { throw new InvalidOperationException("not in this world"); });
            var refused = Refused(() => world.Step(0.1));
            Expect(refused.InnerException is InvalidOperationException, "what a function throws is thrown");
        }
    }

    static void Springs()
    {
        using (var world = new CaromWorld())
        {
            var ball = CaromSphere.Default;
            ball.Position.X = 3.0;
            var first = world.AddSphere(ball);
            ball.Position.X = 6.0;
            var second = world.AddSphere(ball);
            world.AddSpring(CaromSpring.To(first, new Double3(0.0, 0.0, 0.0), 1.0, 2.0));
            var id = world.AddSpring(CaromSpring.Between(first, second, 2.0, 8.0));
            Expect(world.Totals.PotentialEnergy == 4.0 + 4.0, "springs are stretched");
            var spring = world.Spring(id);
            spring.Stiffness = 2.0;
            world.SetSpring(id, spring);
            Expect(world.Totals.PotentialEnergy == 4.0 + 1.0, "a spring is changed");
            world.RemoveSpring(id);
            Expect(world.Ids(CaromList.Springs).Length == 1, "a spring is taken out");
            Expect(Refused(() => world.RemoveSpring(id)).Status == CaromStatus.Unknown, "a stale id is refused");
            spring.Damping = double.NaN;
            Expect(Refused(() => world.AddSpring(spring)).Status == CaromStatus.Invalid, "NaN is no damping");
        }
    }

    static void Queries()
    {
        using (var world = new CaromWorld())
        {
            var ball = CaromSphere.Default;
            var near = world.AddSphere(ball);
            ball.Position.X = 5.0;
            var far = world.AddSphere(ball);
            var filter = CaromQueryFilter.Default;
            var ray = new CaromRay(new Double3(-3.0, 0.0, 0.0), new Double3(8.0, 0.0, 0.0));
            var hits = world.CastRays(new[] { ray }, filter);
            Expect(hits[0].IsHit == 1 && hits[0].Body == near && hits[0].Fraction == 0.25, "a ray meets a ball");
            filter.LeavesOutSphere = 1;
            filter.WithoutSphere = near;
            Expect(world.Nearest(ray.Origin, 100.0, filter).Body == far, "the other ball is the nearest");
            var moving = new CaromMovingSphere { Center = ray.Origin, Radius = 1.0, Way = ray.Way };
            Expect(world.CastSpheres(new[] { moving }, filter)[0].Fraction == 0.75, "a sphere stops before a ball");
            Expect(world.Overlapping(ray.Origin, 3.0, CaromQueryFilter.Default).Length == 1, "one ball is near");
            Expect(Refused(() => world.Nearest(ray.Origin, -1.0, filter)).Status == CaromStatus.Invalid, "no distance");
            world.ApplyImpulse(near, new Double3(4.0, 0.0, 0.0));
            world.ApplyImpulseAt(near, new Double3(0.0, 0.0, 0.0), ray.Origin);
            using (var path = world.Predict(near, 2.0, 9))
            {
                Double3 position, velocity;
                path.At(0.5, out position, out velocity);
                Expect(position.X == 2.0 && velocity.X == 4.0 && path.EndTime == 2.0, "a path is known before");
                Expect(path.Impacts()[0].Time == 0.75 && path.Legs()[0].End == 0.75, "and what is met on it");
            }
            world.Step(1.0);
            Expect(world.Impacts()[0].Time == 0.75 && world.SensorEvents().Length == 0, "then it happens");
        }
    }

    static void Meshes()
    {
        using (var world = new CaromWorld())
        {
            var vertices = new[]
            {
                new Double3(-1.0, 0.0, -1.0), new Double3(-1.0, 0.0, 1.0), new Double3(1.0, 0.0, 1.0),
                new Double3(1.0, 0.0, -1.0),
            };
            var surface = CaromCollider.Default;
            var sheet = world.AddMesh(surface, vertices, new uint[] { 0, 1, 2, 0, 2, 3 }, true);
            Expect(world.Collider(sheet).Shape == CaromShape.Other, "a mesh has a shape of its own");
            surface.Position.Y = -9.0;
            surface.Size = new Double3(2.0, 1.0, 2.0);
            world.AddHeightField(surface, new[,] { { 1.0, 2.0, 3.0 }, { 1.0, 2.0, 3.0 } });
            var down = new Double3(0.0, -16.0, 0.0);
            var rays = new[]
            {
                new CaromRay(new Double3(0.5, 4.0, 0.25), down), new CaromRay(new Double3(0.5, -1.0, 0.25), down),
            };
            var hits = world.CastRays(rays, CaromQueryFilter.Default);
            Expect(hits[0].Body == sheet && hits[0].Point.Y == 0.0, "a ray from above meets the sheet");
            Expect(hits[1].Point.Y == -6.5, "the ground rises by one in one");
            var few = new uint[] { 0, 1, 9 };
            Expect(Refused(() => world.AddMesh(surface, vertices, few, true)).Message.Contains("9"), "no vertex 9");
        }
    }

    static void Motions()
    {
        using (var world = new CaromWorld())
        {
            var lift = CaromCollider.Default;
            lift.Shape = CaromShape.Box;
            lift.Size = new Double3(1.0, 0.5, 1.0);
            var id = world.AddCollider(lift);
            var level = new Double4(0.0, 0.0, 0.0, 1.0);
            var keyframes = new[]
            {
                new CaromKeyframe(0.0, new Double3(), level),
                new CaromKeyframe(2.0, new Double3(0.0, 1.0, 0.0), level),
            };
            world.SetKeyframes(id, keyframes, new Double3(), false);
            for (var frame = 0; frame < 3; frame++) world.Step(1.0);
            Expect(world.Collider(id).Position.Y == 1.0, "a lift arrives");
            Expect(Refused(() => world.SetKeyframes(id, keyframes, new Double3(), true)).Status == CaromStatus.Invalid,
                "it cannot repeat");
            world.SetKeyframes(id, new CaromKeyframe[0], new Double3(), false);
            Expect(world.Collider(id).Position.Y == 0.0, "it is back without its motion");
        }
    }

    static void Games()
    {
        using (var world = CaromWorld.FromToml(
            "[simulation]\npair_potential = { square-well = { depth = 1.0, range_ratio = 1.5 } }"))
        {
            var ball = CaromSphere.Default;
            var first = world.AddSphere(ball);
            ball.Position.X = 4.0 * ball.Radius;
            ball.Velocity.X = -ball.Radius;
            var second = world.AddSphere(ball);
            world.SetGroups(first, 2, 3);
            world.SetUserData(second, 7);
            Expect(world.UserData(first) == 0 && world.UserData(second) == 7, "a number stays with its sphere");
            var gate = CaromCollider.Default;
            gate.Trigger = 1;
            gate.Position.Y = -9.0;
            var id = world.AddCollider(gate);
            world.SetMotion(id, "{ oscillate = { amplitude = 1.0, frequency = 0.125 } }");
            using (var snapshot = world.Snapshot())
            {
                world.Step(1.25);
                var events = world.WellEvents();
                Expect(events.Length == 1 && events[0].Time == 1.0 && events[0].Kind == CaromWellEventKind.Capture,
                    "the balls enter their well after one radius");
                Expect(events[0].First == first && events[0].Second == second, "the smaller id comes first");
                Expect(world.EnergyAccount.Contacts == 0.0 && world.Triggers().Length == 0, "nothing else happens");
                Expect(world.IntegrationEnergy == 0.0, "no force is held");
                world.SnapshotInto(snapshot);
                var hash = world.StateHash;
                world.Step(0.75);
                Expect(Math.Abs(world.Collider(id).Position.Y + 8.0) < 1e-12, "it is up after a quarter of a period");
                world.Restore(snapshot);
                Expect(world.StateHash == hash, "the later snapshot is in the memory of the earlier");
            }
            world.SetMotion(id, "[]");
            world.SetNextPose(id, new Double3(0.0, 0.5, 0.0), new Double4(0.0, 0.0, 0.0, 1.0), 0.25);
            world.Step(0.25);
            Expect(Math.Abs(world.Collider(id).Position.Y - 0.5) < 1e-12, "it is where it was to be");
            Expect(world.Triggers().Length == 2, "both balls are below the surface now");
        }
    }

    static void Cues()
    {
        using (var world = new CaromWorld())
        {
            var id = world.AddSphere(CaromSphere.Default);
            Expect(!world.HasSpin, "a ball at rest does not turn");
            var strike = CaromStrike.Default;
            Expect(strike.Speed == 0.0 && strike.CueMass == 0.567, "a strike has defaults");
            strike.Speed = 3.0;
            strike.CueMass = 1.0;
            strike.OffsetUp = 0.5;
            world.Strike(id, strike);
            var ball = world.Sphere(id);
            // 2 v / (1 + m / M + 5/2 b^2), and 5/2 b / r of it about -z.
            var speed = 2.0 * 3.0 / (2.0 + 2.5 * 0.25);
            Expect(Math.Abs(ball.Velocity.X - speed) < 1e-14, "a cue gives its speed to a ball of its mass");
            Expect(Math.Abs(ball.AngularVelocity.Z + 1.25 * speed) < 1e-14 && world.HasSpin, "a blow above gives spin");
            strike.OffsetUp = 1.0;
            Expect(Refused(() => world.Strike(id, strike)).Status == CaromStatus.Invalid, "a cue cannot miss");
        }
    }

    static void Accounts()
    {
        var scene = "name = 'cup'\nmaterials = { ivory = {}, slate = {} }\n"
            + "colliders = [{ shape = 'half-space', material = 'slate' }]\n"
            + "spheres = [{ radius = 1, position = [0, 2, 0], velocity = [0, -4, 0], material = 'ivory' }]";
        using (var world = CaromWorld.FromToml(scene))
        {
            world.SetMaterialPairs("material_pairs = [{ materials = ['ivory', 'slate'], restitution = 0.25 }]");
            Expect(world.NextEventTime(1.0) == 0.25, "it falls 1 m at 4 m/s");
            world.Step(0.5);
            Expect(world.Sphere(0).Velocity.Y == 1.0, "a pair of materials has its own restitution");
            Expect(world.Report.Impacts == 1 && world.Report.ContactWork < 0.0, "the impact takes energy");
            var group = world.ImpactGroups()[0];
            Expect(group.Count == 1 && group.EnergyAfter == group.EnergyBefore / 16.0, "a sixteenth of it stays");
            Expect(world.Work.Events >= 1 && world.ZoneAccount.Spheres == 0, "and is one event");
            Expect(world.ContactAccount.Residual == 0.0, "nothing lies");
            Expect(Refused(() => world.SetMaterialPairs("material_pairs = 1")).Status == CaromStatus.Scene, "not pairs");
            var sunk = world.Sphere(0);
            sunk.Position.Y = 0.75;
            world.SetSphere(0, sunk);
            var overlaps = world.Overlaps(0.0);
            Expect(overlaps.Length == 1 && overlaps[0].Depth == 0.25, "it is a quarter of a metre deep");
            Expect(overlaps[0].Bodies.Body1IsCollider == 1 && world.Overlaps(0.5).Length == 0, "in the floor");
            Expect(double.IsInfinity(world.LongestStableFrame), "there are no springs");
            world.Time = 7.0;
            Expect(world.Time == 7.0, "time is set");
            var source = "emitters = [{ position = [0, 50, 0], period = 0.5, sphere = { radius = 0.1 } }]";
            var emitter = world.AddToml(source).FirstEmitter;
            world.SetEmitter(emitter, source.Replace("0.1", "0.2"));
            world.Step(0.1);
            Expect(world.Sphere(1).Radius == 0.2, "an emitter is changed");
            world.RemoveEmitter(emitter);
            Expect(Refused(() => world.SetEmitter(emitter, source)).Status == CaromStatus.Unknown, "and removed");
        }
    }

    static void Scenes(string[] hashes)
    {
        foreach (var pair in hashes)
        {
            var parts = pair.Split('=');
            using (var world = CaromWorld.FromScene(parts[0]))
            {
                world.Advance((ulong)Math.Round(10.0 / world.FrameTime));
                var hash = world.StateHash.ToString("x16");
                Expect(hash == parts[1], parts[0] + " has the hash " + parts[1] + ", not " + hash);
            }
        }
        Console.WriteLine("{0} scenes have their hashes", hashes.Length);
    }

#if UNITY_5_3_OR_NEWER
    static void Unity()
    {
        using (var world = new CaromWorld())
        {
            world.AddGravity(new Vector3(0.0f, -9.81f, 0.0f));
            world.AddFloor(0.0f, 1.0f);
            world.AddBox(new Vector3(5.0f, 1.0f, 5.0f), new Vector3(1.0f, 2.0f, 1.0f), new Quaternion(0, 0, 0, 1), 1.0f);
            var ball = world.AddBall(new Vector3(0.0f, 0.5f, 3.0f), 0.5f, new Vector3(0.0f, 0.0f, 2.0f));
            // A quarter turn about y takes forward to the right in Unity, to the left in a right-handed system.
            var turned = world.Sphere(ball);
            turned.Orientation = CaromWorld.FromUnity(new Quaternion(0.0f, 0.6f, 0.0f, 0.8f));
            turned.AngularVelocity = CaromWorld.AngularFromUnity(new Vector3(0.0f, 1.0f, 0.0f));
            Expect(turned.Position.Z == -3.0 && turned.Orientation.Y < 0.0 && turned.AngularVelocity.Y == -1.0,
                "z is mirrored");
            world.SetSphere(ball, turned);
            world.Step(0.5);
            var positions = new Vector3[1];
            var velocities = new Vector3[1];
            var rotations = new Quaternion[1];
            world.ReadPositions(positions);
            world.ReadVelocities(velocities);
            world.ReadRotations(rotations);
            Expect(positions[0].z == 4.0f && velocities[0].z == 2.0f, "it goes on forward");
            var angle = 2.0 * Math.Atan2(rotations[0].y, rotations[0].w);
            Expect(Math.Abs(angle - (2.0 * Math.Atan2(0.6, 0.8) + 0.5)) < 1e-6, "it turns on in its sense");
            Console.WriteLine("Unity: it is at z = {0} m", positions[0].z);
        }
    }

    static void UnityMeshes()
    {
        using (var world = new CaromWorld())
        {
            // The front of a triangle, clockwise in Unity, faces up.
            var ramp = new MeshCollider { sharedMesh = new Mesh() };
            ramp.sharedMesh.vertices = new[]
            {
                new Vector3(0.0f, 0.0f, 0.0f), new Vector3(0.0f, 0.0f, 1.0f), new Vector3(1.0f, 0.0f, 0.0f),
            };
            ramp.sharedMesh.triangles = new[] { 0, 1, 2 };
            ramp.transform.localPosition = new Vector3(10.0f, 3.0f, 2.0f);
            ramp.transform.lossyScale = new Vector3(4.0f, 1.0f, 8.0f);
            var sheet = world.AddMesh(ramp, 1.0f);
            var data = new TerrainData { size = new Vector3(2.0f, 8.0f, 4.0f), heightmapResolution = 2 };
            data.Parts = new[,] { { 0.0f, 0.0f }, { 1.0f, 1.0f } };
            var terrain = new Terrain { terrainData = data };
            terrain.transform.localPosition = new Vector3(0.0f, 1.0f, -4.0f);
            var ground = world.AddTerrain(terrain, 1.0f);
            var down = CaromWorld.FromUnity(new Vector3(0.0f, -32.0f, 0.0f));
            Func<float, float, float, CaromHit> below = (x, y, z) =>
                world.CastRays(new[] { new CaromRay(CaromWorld.FromUnity(new Vector3(x, y, z)), down) },
                    CaromQueryFilter.Default)[0];
            Expect(below(11.0f, 5.0f, 7.0f).Body == sheet && below(11.0f, 5.0f, 7.0f).Point.Y == 3.0, "it is scaled");
            Expect(below(13.0f, 5.0f, 7.0f).IsHit == 0, "beside it is nothing");
            var ball = world.AddBall(new Vector3(10.5f, 2.0f, 3.0f), 0.25f, new Vector3(0.0f, 4.0f, 0.0f));
            world.Step(1.0);
            Expect(world.Sphere(ball).Position.Y == 6.0 && world.Impacts().Length == 0, "it is open from behind");
            var hit = below(0.5f, 20.0f, -1.0f);
            Expect(hit.Body == ground && Math.Abs(hit.Point.Y - 7.0) < 1e-12, "a terrain rises towards z");
        }
    }
#endif

    static int Main(string[] arguments)
    {
        try
        {
            Bounce();
            Functions();
            Springs();
            Queries();
            Meshes();
            Motions();
            Games();
            Cues();
            Accounts();
            Scenes(arguments);
#if UNITY_5_3_OR_NEWER
            Unity();
            UnityMeshes();
#endif
            return 0;
        }
        catch (Exception exception)
        {
            Console.Error.WriteLine(exception);
            return 1;
        }
    }
}
