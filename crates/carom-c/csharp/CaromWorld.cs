// Carom in C#: one file, for Unity, .NET and Mono. docs/c.md is the guide.
//
// In Unity: put this file anywhere into Assets, and the library (carom_c.dll, libcarom_c.so or libcarom_c.dylib) into
// Assets/Plugins. Then, in a script of an empty object, with a prefab of a sphere of diameter 1:
//
//     using Carom;
//     using UnityEngine;
//
//     public class Balls : MonoBehaviour
//     {
//         public Transform prefab;
//         CaromWorld world;
//         Transform[] balls;
//         Vector3[] positions;
//
//         void Start()
//         {
//             world = new CaromWorld();
//             world.AddGravity(Physics.gravity);
//             world.AddFloor(0.0f, 0.8f);
//             balls = new Transform[10];
//             positions = new Vector3[balls.Length];
//             for (int i = 0; i < balls.Length; i++)
//             {
//                 world.AddBall(new Vector3(0.1f * i, 2.0f + i, 0.0f), 0.5f);
//                 balls[i] = Instantiate(prefab);
//             }
//         }
//
//         void FixedUpdate()
//         {
//             world.Step(Time.fixedDeltaTime);
//             world.ReadPositions(positions);
//             for (int i = 0; i < balls.Length; i++) balls[i].position = positions[i];
//         }
//
//         void OnDestroy() { world.Dispose(); }
//     }
//
// Carom's coordinate system is right-handed with y up, Unity's left-handed: members that take or give a Vector3 or a
// Quaternion of Unity mirror z; all others are in Carom's own coordinates.

using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Carom
{
    /// <summary>Result of a call of the library, as in carom.h.</summary>
    public enum CaromStatus
    {
        Ok, Null, Handle, Busy, Length, Argument, Invalid, Unknown, Scene, Step, Stopped, Snapshot, Memory, Abi, Panic,
    }

    /// <summary>A quantity that all spheres have, with as many numbers per sphere as in carom.h.</summary>
    public enum CaromQuantity
    {
        Positions, Velocities, Radii, Masses, Restitutions, Orientations, AngularVelocities, InertiaFactors, Frictions,
        RollingFrictions, SpinningFrictions, TangentialRestitutions, AppliedForces,
    }

    /// <summary>The shape of a collider.</summary>
    public enum CaromShape
    {
        Sphere, Rectangle, HalfSpace, Box, Container, Other,
    }

    /// <summary>A list of ids.</summary>
    public enum CaromList
    {
        Spheres, Colliders, Forces, Emitters, Emitted, Retired, LeftOut, Springs,
    }

    /// <summary>Why the library refused a call. The world is unchanged, but <see cref="CaromWorld.Advance"/> keeps the
    /// frames before the refused one.</summary>
    public sealed class CaromException : Exception
    {
        public CaromStatus Status { get; private set; }

        public CaromException(CaromStatus status, string message, Exception cause) : base(message, cause)
        {
            Status = status;
        }
    }

    /// <summary>Three numbers.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Double3
    {
        public double X, Y, Z;

        public Double3(double x, double y, double z) { X = x; Y = y; Z = z; }

        public override string ToString() { return "(" + X + ", " + Y + ", " + Z + ")"; }
    }

    /// <summary>A quaternion x, y, z, w.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Double4
    {
        public double X, Y, Z, W;

        public Double4(double x, double y, double z, double w) { X = x; Y = y; Z = z; W = w; }
    }

    /// <summary>A sphere; <see cref="Default"/> has default values. SI units; friction is NaN for a sphere without its
    /// own.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromSphere
    {
        public Double3 Position, Velocity;
        public double Radius, Mass, Density, Restitution;
        public double Friction, RollingFriction, SpinningFriction, TangentialRestitution;
        public Double4 Orientation;
        public Double3 AngularVelocity;
        public double InertiaFactor;

        /// <summary>A solid ball of 1 kg and radius 1 m at rest at the origin.</summary>
        public static CaromSphere Default { get { return Native.carom_sphere(); } }
    }

    /// <summary>A collider; <see cref="Default"/> has default values.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromCollider
    {
        public CaromShape Shape;
        public uint Trigger, OpenSides, Reserved;
        public double Radius;
        public Double3 Size, Position;
        public Double4 Rotation;
        public Double3 Velocity, AngularVelocity;
        public double Restitution, Friction, RollingFriction, SpinningFriction, TangentialRestitution;

        /// <summary>A solid half-space below y = 0, at rest.</summary>
        public static CaromCollider Default { get { return Native.carom_collider(); } }
    }

    /// <summary>A spring with a damper from a sphere to another one (ToPoint 0) or to a fixed point (ToPoint 1). With
    /// OnlyPulls 1 it is a thread. <see cref="Between"/> and <see cref="To"/> make one.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromSpring
    {
        public ulong Sphere, Other;
        public uint ToPoint, OnlyPulls;
        public Double3 Point;
        public double RestLength, Stiffness, Damping;

        /// <summary>Makes a spring between two spheres, without damping. SI units.</summary>
        public static CaromSpring Between(ulong sphere, ulong other, double restLength, double stiffness)
        {
            var spring = Native.carom_spring();
            spring.Sphere = sphere;
            spring.Other = other;
            spring.ToPoint = 0;
            spring.RestLength = restLength;
            spring.Stiffness = stiffness;
            return spring;
        }

        /// <summary>Makes a spring from a sphere to a fixed point, without damping. SI units.</summary>
        public static CaromSpring To(ulong sphere, Double3 point, double restLength, double stiffness)
        {
            var spring = Between(sphere, 0, restLength, stiffness);
            spring.ToPoint = 1;
            spring.Point = point;
            return spring;
        }
    }

    /// <summary>The state of a sphere that a force may depend on.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromSphereState
    {
        public Double3 Position, Velocity;
        public double Radius, Mass;
    }

    /// <summary>Ids that a text has added: the first id and the number of each kind.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromAdded
    {
        public ulong FirstSphere, Spheres, FirstCollider, Colliders, FirstForce, Forces, FirstEmitter, Emitters;
    }

    /// <summary>Two bodies: two spheres, or a collider (body 1) and a sphere.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromBodyPair
    {
        public ulong Body1, Body2, Body1IsCollider;
    }

    /// <summary>Which bodies a query finds; <see cref="Default"/> finds spheres and colliders, but no triggers.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromQueryFilter
    {
        public uint Spheres, Colliders, Triggers, LeavesOutSphere;
        public ulong WithoutSphere;
        public uint Groups, CollidesWith;

        public static CaromQueryFilter Default { get { return Native.carom_query_filter(); } }
    }

    /// <summary>A pose that a collider reaches at a time [s]: displacement [m] and rotation from the pose at rest, along
    /// and about the axes of the world.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromKeyframe
    {
        public double Time;
        public Double3 Position;
        public Double4 Rotation;

        public CaromKeyframe(double time, Double3 position, Double4 rotation)
        {
            Time = time;
            Position = position;
            Rotation = rotation;
        }
    }

    /// <summary>A ray from a point along a way to its end [m].</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromRay
    {
        public Double3 Origin, Way;

        public CaromRay(Double3 origin, Double3 way) { Origin = origin; Way = way; }
    }

    /// <summary>A sphere that moves straight along a way to its end [m].</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromMovingSphere
    {
        public Double3 Center;
        public double Radius;
        public Double3 Way;
    }

    /// <summary>What a ray or a moving sphere meets first; IsHit is 0 if it meets nothing.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromHit
    {
        public uint IsHit, IsCollider;
        public ulong Body;
        public Double3 Point, Normal;
        public double Fraction;
    }

    /// <summary>A body near a place; IsFound is 0 if there is none.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromNearBody
    {
        public uint IsFound, IsCollider;
        public ulong Body;
        public Double3 Point, Normal;
        public double Distance;
    }

    /// <summary>A sphere that enters a trigger (Enters 1) or leaves it (0) in the last step.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromSensorEvent
    {
        public double Time;
        public ulong Collider, Sphere, Enters;
        public Double3 Point, Normal;
        public double Speed;
    }

    /// <summary>What happens to two spheres at the edge of the well between them.</summary>
    public enum CaromWellEventKind : ulong { Capture, Dissociation, Bounce }

    /// <summary>Two spheres that enter the well between them, leave it or turn back at its edge.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromWellEvent
    {
        public double Time;
        public ulong First, Second;
        public CaromWellEventKind Kind;
        public Double3 Normal;
        public double Distance, Impulse;
    }

    /// <summary>A sphere inside a trigger at the end of the last step.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromTrigger
    {
        public ulong Collider, Sphere;
        public Double3 Normal, Point;
    }

    /// <summary>Changes of the energy in the last step [J].</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromEnergyAccount
    {
        public double Contacts, Colliders, Kicks, Growth, Shear, Thermostat, Forces, Applied, Correction, Emission;
    }

    /// <summary>The work of the last step by stage: counts that depend only on the world.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromStageCounts
    {
        public ulong Predictions, PairTests, Events, CellCrossings, Groups, SolverIterations, Searches, Sweeps, Contacts;
    }

    /// <summary>Quality of the solution of the last step under the rule contact, and in stepped zones of exact.
    /// Residual is relative to the largest impulse, LargestOverlap to the sum of radii.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromContactAccount
    {
        public ulong LimitedSubSteps, Asleep, Squeezed;
        public double Residual, LargestOverlap;
    }

    /// <summary>Spheres that the rule exact stepped in the last step instead of moving them from impact to impact, and
    /// their total time there [s].</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromZoneAccount
    {
        public ulong Spheres, Ticks, Joined, Left;
        public double SphereSeconds;
    }

    /// <summary>Impacts at one instant among bodies that touch, with their common momentum [kg m/s] and energy [J]. First
    /// is the index of its first impact in <see cref="CaromWorld.Impacts"/>.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromImpactGroup
    {
        public ulong First, Count;
        public Double3 MomentumBefore, MomentumAfter;
        public double EnergyBefore, EnergyAfter, EnergyDemanded, ColliderWork, KickWork;
    }

    /// <summary>Counts and energies [J] of the last step.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromReport
    {
        public ulong Impacts, ZoneSpheres, WasStepped, UnfinishedIslands, Asleep, Squeezed;
        public double ContactWork, ColliderWork, CorrectionWork, EmissionEnergy, Residual, LargestOverlap;
    }

    /// <summary>Two bodies that overlap, and the depth of the overlap [m].</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromOverlap
    {
        public CaromBodyPair Bodies;
        public double Depth;
    }

    /// <summary>A blow of a cue on a sphere: speed [m/s], azimuth from +x towards -z and angle down [degrees], offset
    /// from the centre in parts of the radius, mass [kg]. <see cref="Default"/> has default values.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromStrike
    {
        public double Speed, AzimuthDegrees, ElevationDegrees, OffsetRight, OffsetUp, CueMass;

        /// <summary>A level strike at the middle along +x, with speed 0 by a cue of 0.567 kg.</summary>
        public static CaromStrike Default { get { return Native.carom_strike(); } }
    }

    /// <summary>A piece of a predicted path: a flight from an event to the next.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromPathLeg
    {
        public double Start, End, FlightStart;
        public Double3 Position, Velocity, Acceleration;
        public double DragRate;
    }

    /// <summary>One impact of the last step.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromImpact
    {
        public double Time;
        public CaromBodyPair Bodies;
        public Double3 Point, Normal;
        public double ApproachSpeed, SeparationSpeed, Impulse;
        public Double3 TangentialImpulse;
    }

    /// <summary>A persistent contact.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromContact
    {
        public CaromBodyPair Bodies;
        public Double3 Point, Normal;
        public double Gap, NormalForce;
        public Double3 TangentialForce;
        public ulong IsSliding;
    }

    /// <summary>Sums over all spheres.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct CaromTotals
    {
        public double KineticEnergy, RotationalEnergy, PotentialEnergy;
        public Double3 Momentum, AngularMomentum;
    }

    /// <summary>A world of spheres with exact motion. Only one thread at a time may use it.</summary>
    public sealed partial class CaromWorld : IDisposable
    {
        readonly Native.Handle handle;

        CaromWorld(WorldId id) { handle = new Native.Handle(id.Id, 0); }

        /// <summary>Makes an empty world at time 0.</summary>
        public CaromWorld() : this(Made(Native.carom_world_new)) { }

        /// <summary>Makes the world of a built-in scene, by its name, or of a scene file, by its path. Overrides are
        /// texts like "simulation.rule=contact".</summary>
        public static CaromWorld FromScene(string name, params string[] overrides)
        {
            using (var texts = new Native.Texts(overrides))
            {
                WorldId id;
                var status = Native.carom_world_from_scene(Native.Text(name), texts.Pointers, texts.Count, out id);
                Native.Check(status);
                return new CaromWorld(id);
            }
        }

        /// <summary>Makes the world of a scene file's text (TOML).</summary>
        public static CaromWorld FromToml(string toml, params string[] overrides)
        {
            using (var texts = new Native.Texts(overrides))
            {
                WorldId id;
                var status = Native.carom_world_from_toml(Native.Text(toml), texts.Pointers, texts.Count, out id);
                Native.Check(status);
                return new CaromWorld(id);
            }
        }

        /// <summary>Returns an independent copy.</summary>
        public CaromWorld Copy()
        {
            WorldId copy;
            Check(Native.carom_world_copy(Id, out copy));
            return new CaromWorld(copy);
        }

        public void Dispose() { handle.Dispose(); }

        WorldId Id { get { return new WorldId { Id = handle.Id }; } }

        // Keeps the world alive until a call has ended: an object may be freed after its last use.
        void Check(CaromStatus status)
        {
            GC.KeepAlive(handle);
            Native.Check(status);
        }

        delegate CaromStatus Maker(out WorldId id);

        static WorldId Made(Maker make)
        {
            WorldId id;
            Native.Check(make(out id));
            return id;
        }

        /// <summary>Advances the world by dt seconds.</summary>
        public void Step(double dt) { Check(Native.carom_world_step(Id, dt)); }

        /// <summary>Advances the world by a number of frames of its frame time.</summary>
        public void Advance(ulong frames)
        {
            ulong taken;
            Check(Native.carom_world_advance(Id, frames, out taken));
        }

        /// <summary>Advances the world to its next impact, at most by this many seconds.</summary>
        public void StepToNextEvent(double within) { Check(Native.carom_world_step_to_next_event(Id, within)); }

        /// <summary>Returns the time of the next impact [s]; infinity if none comes within this many seconds.</summary>
        public double NextEventTime(double within)
        {
            double time;
            Check(Native.carom_world_next_event_time(Id, within, out time));
            return time;
        }

        /// <summary>Stops the step in another thread and refuses further ones, or allows steps again.</summary>
        public bool Stop { set { Check(Native.carom_world_set_stop(Id, value ? 1 : 0)); } }

        /// <summary>Time since the start [s]. It can be set, for forces that depend on it, in a world without
        /// emitters.</summary>
        public double Time
        {
            get { double it; Check(Native.carom_world_time(Id, out it)); return it; }
            set { Check(Native.carom_world_set_time(Id, value)); }
        }

        /// <summary>Frame time [s].</summary>
        public double FrameTime { get { double it; Check(Native.carom_world_frame_time(Id, out it)); return it; } }

        /// <summary>The longest frame [s] in which motion on springs is certainly stable; else infinity.</summary>
        public double LongestStableFrame
        {
            get { double it; Check(Native.carom_world_longest_stable_frame(Id, out it)); return it; }
        }

        /// <summary>State hash, equal for equal states everywhere.</summary>
        public ulong StateHash { get { ulong it; Check(Native.carom_world_state_hash(Id, out it)); return it; } }

        /// <summary>The number of spheres.</summary>
        public int Count { get { UIntPtr it; Check(Native.carom_world_count(Id, out it)); return (int)it; } }

        /// <summary>Energies and momenta.</summary>
        public CaromTotals Totals
        {
            get { CaromTotals it; Check(Native.carom_world_totals(Id, out it)); return it; }
        }

        /// <summary>Adds a sphere. Returns its id.</summary>
        public ulong AddSphere(CaromSphere sphere)
        {
            ulong id;
            Check(Native.carom_world_add_sphere(Id, ref sphere, out id));
            return id;
        }

        /// <summary>Adds spheres, all or none. Returns their ids.</summary>
        public ulong[] AddSpheres(CaromSphere[] spheres)
        {
            var ids = new ulong[spheres.Length];
            var count = (UIntPtr)spheres.Length;
            Check(Native.carom_world_add_spheres(Id, spheres, UIntPtr.Zero, count, ids));
            return ids;
        }

        /// <summary>Returns a sphere.</summary>
        public CaromSphere Sphere(ulong id)
        {
            CaromSphere sphere;
            Check(Native.carom_world_sphere(Id, id, out sphere));
            return sphere;
        }

        /// <summary>Replaces a sphere.</summary>
        public void SetSphere(ulong id, CaromSphere sphere) { Check(Native.carom_world_set_sphere(Id, id, ref sphere)); }

        /// <summary>Removes spheres.</summary>
        public void RemoveSpheres(params ulong[] ids)
        {
            Check(Native.carom_world_remove_spheres(Id, ids, (UIntPtr)ids.Length));
        }

        /// <summary>Adds a collider. Returns its id.</summary>
        public ulong AddCollider(CaromCollider collider)
        {
            ulong id;
            Check(Native.carom_world_add_collider(Id, ref collider, out id));
            return id;
        }

        /// <summary>Adds a surface of triangles: three indices of vertices [m] each, counter-clockwise as seen from the
        /// front. If it is one-sided and open, spheres pass it from behind. The shape of the collider is ignored.
        /// </summary>
        public ulong AddMesh(CaromCollider collider, Double3[] vertices, uint[] triangles, bool isOneSided)
        {
            collider.Shape = CaromShape.Other;
            ulong id;
            Check(Native.AddMesh(Id, ref collider, vertices, triangles, isOneSided, out id));
            return id;
        }

        /// <summary>Adds ground over a rectangle of Size.X by Size.Z about the origin of the collider: heights [m], in
        /// rows along x, the first at the lowest z. Spheres pass it from below. The shape of the collider is ignored.
        /// </summary>
        public ulong AddHeightField(CaromCollider collider, double[,] heights)
        {
            collider.Shape = CaromShape.Other;
            UIntPtr rows = (UIntPtr)heights.GetLength(0), columns = (UIntPtr)heights.GetLength(1);
            ulong id;
            Check(Native.carom_world_add_height_field(Id, ref collider, heights, rows, columns, out id));
            return id;
        }

        /// <summary>Returns a collider in its present pose.</summary>
        public CaromCollider Collider(ulong id)
        {
            CaromCollider collider;
            Check(Native.carom_world_collider(Id, id, out collider));
            return collider;
        }

        /// <summary>Replaces all properties of a collider; it moves at once.</summary>
        public void SetCollider(ulong id, CaromCollider collider)
        {
            Check(Native.carom_world_set_collider(Id, id, ref collider));
        }

        /// <summary>Sets the velocity of the material of a collider along its surface [m/s], in its own
        /// coordinates, as of a conveyor belt: friction feels it, and the shape stays.</summary>
        public void SetSurfaceVelocity(ulong collider, Double3 velocity)
        {
            Check(Native.carom_world_set_surface_velocity(Id, collider, ref velocity));
        }

        /// <summary>Moves a collider through two or more poses, ascending by time, and turns it about a pivot [m] from
        /// its position at rest. It rests before and after, or the motion repeats. Without keyframes it stops where it
        /// is without a motion.</summary>
        public void SetKeyframes(ulong collider, CaromKeyframe[] keyframes, Double3 pivot, bool repeats)
        {
            var count = (UIntPtr)keyframes.Length;
            Check(Native.carom_world_set_keyframes(Id, collider, keyframes, count, ref pivot, repeats ? 1u : 0u));
        }

        /// <summary>Sets the motion of a collider from the field motion of a scene file:
        /// "{ turn = { rate = 2.0 } }"; "[]" removes it.</summary>
        public void SetMotion(ulong collider, string toml)
        {
            Check(Native.carom_world_set_motion(Id, collider, Native.Text(toml)));
        }

        /// <summary>Moves a collider steadily to a pose that it reaches in a time [s], before each step of that
        /// time; it strikes spheres on the way.</summary>
        public void SetNextPose(ulong collider, Double3 position, Double4 rotation, double dt)
        {
            Check(Native.carom_world_set_next_pose(Id, collider, ref position, ref rotation, dt));
        }

        /// <summary>Removes a collider.</summary>
        public void RemoveCollider(ulong id) { Check(Native.carom_world_remove_collider(Id, id)); }

        /// <summary>Adds gravity [m/s^2]. Returns its id.</summary>
        public ulong AddGravity(Double3 acceleration)
        {
            ulong id;
            Check(Native.carom_world_add_gravity(Id, ref acceleration, out id));
            return id;
        }

        /// <summary>Adds viscous drag [kg/s]. Returns its id.</summary>
        public ulong AddDrag(double coefficient)
        {
            ulong id;
            Check(Native.carom_world_add_drag(Id, coefficient, out id));
            return id;
        }

        /// <summary>Adds a force [N] that is a function of a sphere's state and of time, with its potential energy [J]
        /// or null. Returns its id. The step that calls the functions throws their exceptions.</summary>
        public ulong AddForce(
            Func<CaromSphereState, double, Double3> force, Func<CaromSphereState, double, double> potentialEnergy = null)
        {
            ulong id = Native.AddForce(Id, force, potentialEnergy);
            GC.KeepAlive(handle);
            return id;
        }

        /// <summary>Removes a force.</summary>
        public void RemoveForce(ulong id) { Check(Native.carom_world_remove_force(Id, id)); }

        /// <summary>Adds a spring. Returns its id.</summary>
        public ulong AddSpring(CaromSpring spring)
        {
            ulong id;
            Check(Native.carom_world_add_spring(Id, ref spring, out id));
            return id;
        }

        /// <summary>Returns a spring.</summary>
        public CaromSpring Spring(ulong id)
        {
            CaromSpring spring;
            Check(Native.carom_world_spring(Id, id, out spring));
            return spring;
        }

        /// <summary>Replaces a spring.</summary>
        public void SetSpring(ulong id, CaromSpring spring) { Check(Native.carom_world_set_spring(Id, id, ref spring)); }

        /// <summary>Removes a spring; its spheres stay.</summary>
        public void RemoveSpring(ulong id) { Check(Native.carom_world_remove_spring(Id, id)); }

        /// <summary>Adds the spheres, generators, springs, colliders, forces and emitters of a text (TOML).</summary>
        public CaromAdded AddToml(string toml)
        {
            CaromAdded added;
            Check(Native.carom_world_add_toml(Id, Native.Text(toml), out added));
            return added;
        }

        /// <summary>Sets the pairs of materials from the tables of a scene file:
        /// "material_pairs = [{ materials = ['ivory', 'slate'], restitution = 0.9 }]". The materials are those of the
        /// scene; an empty text removes all pairs.</summary>
        public void SetMaterialPairs(string toml)
        {
            Check(Native.carom_world_set_material_pairs(Id, Native.Text(toml)));
        }

        /// <summary>Replaces an emitter by that of a text: "emitters = [{ sphere = { radius = 0.1 }, period = 0.5 }]".
        /// With another period it starts again now.</summary>
        public void SetEmitter(ulong id, string toml) { Check(Native.carom_world_set_emitter(Id, id, Native.Text(toml))); }

        /// <summary>Removes an emitter; its spheres stay.</summary>
        public void RemoveEmitter(ulong id) { Check(Native.carom_world_remove_emitter(Id, id)); }

        /// <summary>Sets the simulation settings from the table [simulation] of a text (TOML).</summary>
        public void SetSimulation(string toml)
        {
            Check(Native.carom_world_set_simulation(Id, Native.Text(toml)));
        }

        /// <summary>Reads a quantity of all spheres, one after another.</summary>
        public void Read(CaromQuantity quantity, double[] values)
        {
            var rows = Native.Rows(quantity, values.Length);
            Check(Native.carom_world_read(Id, quantity, values, UIntPtr.Zero, rows));
        }

        /// <summary>Reads a quantity of three numbers of all spheres.</summary>
        public void Read(CaromQuantity quantity, Double3[] values)
        {
            Native.RequireWidth(quantity, 3);
            Check(Native.carom_world_read(Id, quantity, values, UIntPtr.Zero, (UIntPtr)values.Length));
        }

        /// <summary>Writes a quantity of all spheres, one after another.</summary>
        public void Write(CaromQuantity quantity, double[] values)
        {
            var rows = Native.Rows(quantity, values.Length);
            Check(Native.carom_world_write(Id, quantity, values, UIntPtr.Zero, rows));
        }

        /// <summary>Writes a quantity of three numbers of all spheres.</summary>
        public void Write(CaromQuantity quantity, Double3[] values)
        {
            Native.RequireWidth(quantity, 3);
            Check(Native.carom_world_write(Id, quantity, values, UIntPtr.Zero, (UIntPtr)values.Length));
        }

        /// <summary>Returns a list of ids.</summary>
        public ulong[] Ids(CaromList list)
        {
            Native.Reader<WorldId, ulong> read =
                (WorldId world, ulong[] items, UIntPtr stride, UIntPtr capacity, out UIntPtr count) =>
                    Native.carom_world_ids(world, list, items, stride, capacity, out count);
            return Native.All(read, Id);
        }

        /// <summary>Returns the impacts of the last step in order of time.</summary>
        public CaromImpact[] Impacts()
        {
            return Native.All<WorldId, CaromImpact>(Native.carom_world_impacts, Id);
        }

        /// <summary>Returns each entry of a sphere into a trigger, and each exit, in the last step.</summary>
        public CaromSensorEvent[] SensorEvents()
        {
            return Native.All<WorldId, CaromSensorEvent>(Native.carom_world_sensor_events, Id);
        }

        /// <summary>Returns the events of pairs of spheres at the edges of wells in the last step.</summary>
        public CaromWellEvent[] WellEvents()
        {
            return Native.All<WorldId, CaromWellEvent>(Native.carom_world_well_events, Id);
        }

        /// <summary>Returns the spheres inside triggers at the end of the last step.</summary>
        public CaromTrigger[] Triggers()
        {
            return Native.All<WorldId, CaromTrigger>(Native.carom_world_triggers, Id);
        }

        /// <summary>Changes of the energy in the last step.</summary>
        public CaromEnergyAccount EnergyAccount
        {
            get { CaromEnergyAccount it; Check(Native.carom_world_energy_account(Id, out it)); return it; }
        }

        /// <summary>Energy that held forces added in the last step under the rule exact [J].</summary>
        public double IntegrationEnergy
        {
            get { double it; Check(Native.carom_world_integration_energy(Id, out it)); return it; }
        }

        /// <summary>Sets the groups that a sphere is in and those that it collides with, one bit for each.</summary>
        public void SetGroups(ulong sphere, uint groups, uint collidesWith)
        {
            Check(Native.carom_world_set_groups(Id, sphere, groups, collidesWith));
        }

        /// <summary>Returns the number of a sphere for programs.</summary>
        public ulong UserData(ulong sphere)
        {
            ulong it;
            Check(Native.carom_world_user_data(Id, sphere, out it));
            return it;
        }

        /// <summary>Sets the number of a sphere for programs.</summary>
        public void SetUserData(ulong sphere, ulong userData)
        {
            Check(Native.carom_world_set_user_data(Id, sphere, userData));
        }

        /// <summary>Returns what each ray meets first; many in one call are fast.</summary>
        public CaromHit[] CastRays(CaromRay[] rays, CaromQueryFilter filter)
        {
            var hits = new CaromHit[rays.Length];
            Check(Native.carom_world_cast_rays(Id, rays, (UIntPtr)rays.Length, ref filter, hits));
            return hits;
        }

        /// <summary>Returns what each moving sphere meets first.</summary>
        public CaromHit[] CastSpheres(CaromMovingSphere[] spheres, CaromQueryFilter filter)
        {
            var hits = new CaromHit[spheres.Length];
            Check(Native.carom_world_cast_spheres(Id, spheres, (UIntPtr)spheres.Length, ref filter, hits));
            return hits;
        }

        /// <summary>Returns the body nearest to a point, up to a distance [m].</summary>
        public CaromNearBody Nearest(Double3 point, double within, CaromQueryFilter filter)
        {
            CaromNearBody nearest;
            Check(Native.carom_world_nearest(Id, ref point, within, ref filter, out nearest));
            return nearest;
        }

        /// <summary>Returns the bodies that touch or overlap a sphere [m].</summary>
        public CaromNearBody[] Overlapping(Double3 center, double radius, CaromQueryFilter filter)
        {
            var sphere = new CaromMovingSphere { Center = center, Radius = radius };
            UIntPtr count;
            Check(Native.carom_world_overlapping(Id, ref sphere, ref filter, null, UIntPtr.Zero, out count));
            var bodies = new CaromNearBody[(int)count];
            Check(Native.carom_world_overlapping(Id, ref sphere, ref filter, bodies, count, out count));
            return bodies;
        }

        /// <summary>Predicts the path of a sphere for a time [s], or up to an impact, without a step.</summary>
        public CaromPath Predict(ulong sphere, double horizon, ulong mostImpacts)
        {
            PathId path;
            Check(Native.carom_world_predict(Id, sphere, horizon, (UIntPtr)mostImpacts, out path));
            return new CaromPath(path);
        }

        /// <summary>Strikes a sphere with a cue: its velocity and angular velocity change at once.</summary>
        public void Strike(ulong sphere, CaromStrike strike)
        {
            Check(Native.carom_world_strike(Id, sphere, ref strike));
        }

        /// <summary>Applies an impulse [N s] to a sphere at its centre.</summary>
        public void ApplyImpulse(ulong sphere, Double3 impulse)
        {
            Check(Native.carom_world_apply_impulse(Id, sphere, ref impulse));
        }

        /// <summary>Applies an impulse [N s] to a sphere at a point [m].</summary>
        public void ApplyImpulseAt(ulong sphere, Double3 impulse, Double3 point)
        {
            Check(Native.carom_world_apply_impulse_at(Id, sphere, ref impulse, ref point));
        }

        /// <summary>Returns the bodies that overlap by more than a depth [m].</summary>
        public CaromOverlap[] Overlaps(double tolerance)
        {
            Native.Reader<WorldId, CaromOverlap> read =
                (WorldId world, CaromOverlap[] items, UIntPtr stride, UIntPtr capacity, out UIntPtr count) =>
                    Native.carom_world_overlaps(world, tolerance, items, stride, capacity, out count);
            return Native.All(read, Id);
        }

        /// <summary>Whether spheres are rotated or rotate, or may start to by friction.</summary>
        public bool HasSpin { get { uint it; Check(Native.carom_world_has_spin(Id, out it)); return it != 0; } }

        /// <summary>Returns the groups of impacts at one time of the last step.</summary>
        public CaromImpactGroup[] ImpactGroups()
        {
            return Native.All<WorldId, CaromImpactGroup>(Native.carom_world_impact_groups, Id);
        }

        /// <summary>Counts and energies of the last step.</summary>
        public CaromReport Report
        {
            get { CaromReport it; Check(Native.carom_world_report(Id, out it)); return it; }
        }

        /// <summary>The work of the last step by stage.</summary>
        public CaromStageCounts Work
        {
            get { CaromStageCounts it; Check(Native.carom_world_work(Id, out it)); return it; }
        }

        /// <summary>Quality of the solution of the last step.</summary>
        public CaromContactAccount ContactAccount
        {
            get { CaromContactAccount it; Check(Native.carom_world_contact_account(Id, out it)); return it; }
        }

        /// <summary>Spheres that were stepped in the last step.</summary>
        public CaromZoneAccount ZoneAccount
        {
            get { CaromZoneAccount it; Check(Native.carom_world_zone_account(Id, out it)); return it; }
        }

        /// <summary>Returns the persistent contacts with their forces.</summary>
        public CaromContact[] Contacts()
        {
            return Native.All<WorldId, CaromContact>(Native.carom_world_contacts, Id);
        }

        /// <summary>Returns a snapshot of everything that the future depends on.</summary>
        public CaromSnapshot Snapshot()
        {
            SnapshotId id;
            Check(Native.carom_world_snapshot(Id, out id));
            return new CaromSnapshot(id);
        }

        /// <summary>Takes a snapshot into the memory of an earlier one, which is overwritten.</summary>
        public void SnapshotInto(CaromSnapshot snapshot)
        {
            var status = Native.carom_world_snapshot_into(Id, snapshot.Id);
            GC.KeepAlive(snapshot);
            Check(status);
        }

        /// <summary>Restores a snapshot, bit for bit.</summary>
        public void Restore(CaromSnapshot snapshot)
        {
            var status = Native.carom_world_restore(Id, snapshot.Id);
            GC.KeepAlive(snapshot);
            Check(status);
        }
    }

    /// <summary>The state of a world at one time.</summary>
    public sealed class CaromSnapshot : IDisposable
    {
        readonly Native.Handle handle;

        internal CaromSnapshot(SnapshotId id) { handle = new Native.Handle(0, id.Id); }

        internal SnapshotId Id { get { return new SnapshotId { Id = handle.SnapshotId }; } }

        // As for a world.
        void Check(CaromStatus status)
        {
            GC.KeepAlive(handle);
            Native.Check(status);
        }

        /// <summary>Makes a snapshot from bytes of <see cref="ToBytes"/>. Read only bytes that you trust.</summary>
        public static CaromSnapshot FromBytes(byte[] bytes)
        {
            SnapshotId id;
            Native.Check(Native.carom_snapshot_from_bytes(bytes, (UIntPtr)bytes.Length, out id));
            return new CaromSnapshot(id);
        }

        /// <summary>Returns the snapshot as bytes; not possible with a force that is a function.</summary>
        public byte[] ToBytes()
        {
            UIntPtr size;
            Check(Native.carom_snapshot_to_bytes(Id, null, UIntPtr.Zero, out size));
            var bytes = new byte[(int)size];
            Check(Native.carom_snapshot_to_bytes(Id, bytes, size, out size));
            return bytes;
        }

        public void Dispose() { handle.Dispose(); }
    }

    /// <summary>The predicted path of a sphere.</summary>
    public sealed class CaromPath : IDisposable
    {
        readonly Native.PathHandle handle;

        internal CaromPath(PathId id) { handle = new Native.PathHandle(id); }

        // As for a world.
        void Check(CaromStatus status)
        {
            GC.KeepAlive(handle);
            Native.Check(status);
        }

        /// <summary>When the path ends, on the world's clock [s].</summary>
        public double EndTime
        {
            get
            {
                int end;
                double time;
                Check(Native.carom_path_end(handle.Id, out end, out time));
                return time;
            }
        }

        /// <summary>Reads centre [m] and velocity [m/s] at a time of the path, on the world's clock [s].</summary>
        public void At(double time, out Double3 position, out Double3 velocity)
        {
            Check(Native.carom_path_at(handle.Id, time, out position, out velocity));
        }

        /// <summary>Returns the impacts on the way; their times are from the prediction on.</summary>
        public CaromImpact[] Impacts()
        {
            return Native.All<PathId, CaromImpact>(Native.carom_path_impacts, handle.Id);
        }

        /// <summary>Returns the flights of the path, one after the other.</summary>
        public CaromPathLeg[] Legs()
        {
            return Native.All<PathId, CaromPathLeg>(Native.carom_path_legs, handle.Id);
        }

        public void Dispose() { handle.Dispose(); }
    }

#if UNITY_5_3_OR_NEWER
    /// <summary>Methods in the coordinates of Unity, with z mirrored.</summary>
    public sealed partial class CaromWorld
    {
        /// <summary>Converts a position or velocity from Unity to Carom.</summary>
        public static Double3 FromUnity(UnityEngine.Vector3 it) { return new Double3(it.x, it.y, -it.z); }

        /// <summary>Converts a position or velocity from Carom to Unity.</summary>
        public static UnityEngine.Vector3 ToUnity(Double3 it)
        {
            return new UnityEngine.Vector3((float)it.X, (float)it.Y, (float)-it.Z);
        }

        /// <summary>Converts a rotation from Unity to Carom.</summary>
        public static Double4 FromUnity(UnityEngine.Quaternion it) { return new Double4(-it.x, -it.y, it.z, it.w); }

        /// <summary>Converts a rotation from Carom to Unity.</summary>
        public static UnityEngine.Quaternion ToUnity(Double4 it)
        {
            return new UnityEngine.Quaternion((float)-it.X, (float)-it.Y, (float)it.Z, (float)it.W);
        }

        /// <summary>Converts an angular velocity from Unity to Carom; its sense of rotation is mirrored, too.</summary>
        public static Double3 AngularFromUnity(UnityEngine.Vector3 it) { return new Double3(-it.x, -it.y, it.z); }

        /// <summary>Converts an angular velocity from Carom to Unity.</summary>
        public static UnityEngine.Vector3 AngularToUnity(Double3 it)
        {
            return new UnityEngine.Vector3((float)-it.X, (float)-it.Y, (float)it.Z);
        }

        /// <summary>Adds gravity, for example Physics.gravity.</summary>
        public ulong AddGravity(UnityEngine.Vector3 acceleration) { return AddGravity(FromUnity(acceleration)); }

        /// <summary>Adds a floor: everything below y = height.</summary>
        public ulong AddFloor(float height, float restitution)
        {
            var floor = CaromCollider.Default;
            floor.Position.Y = height;
            floor.Restitution = restitution;
            return AddCollider(floor);
        }

        /// <summary>Adds a box, like a BoxCollider of this size.</summary>
        public ulong AddBox(
            UnityEngine.Vector3 center, UnityEngine.Vector3 size, UnityEngine.Quaternion rotation, float restitution)
        {
            var box = CaromCollider.Default;
            box.Shape = CaromShape.Box;
            box.Size = new Double3(size.x, size.y, size.z);
            box.Position = FromUnity(center);
            box.Rotation = FromUnity(rotation);
            box.Restitution = restitution;
            return AddCollider(box);
        }

        /// <summary>Adds the mesh of a MeshCollider where it is now. As in Unity, balls pass an open one from behind; a
        /// convex one counts as its mesh.</summary>
        public ulong AddMesh(UnityEngine.MeshCollider collider, float restitution)
        {
            var place = collider.transform;
            var back = UnityEngine.Quaternion.Inverse(place.rotation);
            var points = collider.sharedMesh.vertices;
            var vertices = new Double3[points.Length];
            for (int i = 0; i < points.Length; i++)
            {
                vertices[i] = FromUnity(back * (place.TransformPoint(points[i]) - place.position));
            }
            var indices = collider.sharedMesh.triangles;
            // Fronts are clockwise in Unity; a scale that mirrors the mesh turns them round once more.
            var scale = place.lossyScale;
            int second = scale.x * scale.y * scale.z < 0.0f ? 1 : 2;
            var triangles = new uint[indices.Length];
            for (int i = 0; i + 2 < indices.Length; i += 3)
            {
                triangles[i] = (uint)indices[i];
                triangles[i + 1] = (uint)indices[i + second];
                triangles[i + 2] = (uint)indices[i + 3 - second];
            }
            var surface = CaromCollider.Default;
            surface.Position = FromUnity(place.position);
            surface.Rotation = FromUnity(place.rotation);
            surface.Restitution = restitution;
            return AddMesh(surface, vertices, triangles, true);
        }

        /// <summary>Adds a terrain. The diagonal of a cell begins at its lowest x and highest z.</summary>
        public ulong AddTerrain(UnityEngine.Terrain terrain, float restitution)
        {
            var data = terrain.terrainData;
            int side = data.heightmapResolution;
            var parts = data.GetHeights(0, 0, side, side);
            var heights = new double[side, side];
            for (int row = 0; row < side; row++)
            {
                for (int column = 0; column < side; column++)
                {
                    heights[side - 1 - row, column] = (double)parts[row, column] * data.size.y;
                }
            }
            var ground = CaromCollider.Default;
            ground.Size = new Double3(data.size.x, 1.0, data.size.z);
            var middle = new UnityEngine.Vector3(0.5f * data.size.x, 0.0f, 0.5f * data.size.z);
            ground.Position = FromUnity(terrain.transform.position + middle);
            ground.Restitution = restitution;
            return AddHeightField(ground, heights);
        }

        /// <summary>Adds a ball of 1 kg at rest. Returns its id.</summary>
        public ulong AddBall(UnityEngine.Vector3 position, float radius)
        {
            return AddBall(position, radius, new UnityEngine.Vector3(0.0f, 0.0f, 0.0f));
        }

        /// <summary>Adds a ball of 1 kg. Returns its id.</summary>
        public ulong AddBall(UnityEngine.Vector3 position, float radius, UnityEngine.Vector3 velocity)
        {
            var ball = CaromSphere.Default;
            ball.Position = FromUnity(position);
            ball.Velocity = FromUnity(velocity);
            ball.Radius = radius;
            return AddSphere(ball);
        }

        /// <summary>Reads the positions of all balls.</summary>
        public void ReadPositions(UnityEngine.Vector3[] positions) { Read(CaromQuantity.Positions, positions); }

        /// <summary>Reads the velocities of all balls.</summary>
        public void ReadVelocities(UnityEngine.Vector3[] velocities) { Read(CaromQuantity.Velocities, velocities); }

        void Read(CaromQuantity quantity, UnityEngine.Vector3[] values)
        {
            var count = (UIntPtr)values.Length;
            Check(Native.carom_world_read_f32(Id, quantity, values, UIntPtr.Zero, count));
            for (int i = 0; i < values.Length; i++) values[i].z = -values[i].z;
        }

        /// <summary>Reads the orientations of all balls.</summary>
        public void ReadRotations(UnityEngine.Quaternion[] rotations)
        {
            var count = (UIntPtr)rotations.Length;
            Check(
                Native.carom_world_read_f32(Id, CaromQuantity.Orientations, rotations, UIntPtr.Zero, count));
            for (int i = 0; i < rotations.Length; i++)
            {
                rotations[i].x = -rotations[i].x;
                rotations[i].y = -rotations[i].y;
            }
        }
    }
#endif

    [StructLayout(LayoutKind.Sequential)]
    struct WorldId
    {
        public ulong Id;
    }

    [StructLayout(LayoutKind.Sequential)]
    struct SnapshotId
    {
        public ulong Id;
    }

    [StructLayout(LayoutKind.Sequential)]
    struct PathId
    {
        public ulong Id;
    }

    /// <summary>Marks a function that the library calls, for Unity's compiler to C++.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type) { }
    }

    /// <summary>The functions of carom.h.</summary>
    static class Native
    {
        const string Library = "carom_c";
        const uint AbiVersion = 3;

        static Native() { Check(carom_check_abi(AbiVersion)); }

        /// <summary>Frees a world or a snapshot once.</summary>
        internal sealed class Handle : SafeHandle
        {
            internal readonly ulong Id, SnapshotId;

            internal Handle(ulong world, ulong snapshot) : base(IntPtr.Zero, true)
            {
                Id = world;
                SnapshotId = snapshot;
                SetHandle(new IntPtr(1));
            }

            public override bool IsInvalid { get { return Id == 0 && SnapshotId == 0; } }

            protected override bool ReleaseHandle()
            {
                if (Id != 0) return carom_world_free(new WorldId { Id = Id }) == CaromStatus.Ok;
                return carom_snapshot_free(new SnapshotId { Id = SnapshotId }) == CaromStatus.Ok;
            }
        }

        /// <summary>Frees a path once.</summary>
        internal sealed class PathHandle : SafeHandle
        {
            internal readonly PathId Id;

            internal PathHandle(PathId id) : base(IntPtr.Zero, true)
            {
                Id = id;
                SetHandle(new IntPtr(1));
            }

            public override bool IsInvalid { get { return Id.Id == 0; } }

            protected override bool ReleaseHandle() { return carom_path_free(Id) == CaromStatus.Ok; }
        }

        /// <summary>Throws unless a call succeeded.</summary>
        internal static void Check(CaromStatus status)
        {
            var cause = thrown;
            thrown = null;
            if (status == CaromStatus.Ok && cause == null) return;
            string message = status == CaromStatus.Ok ? "a function of a force has thrown" : TextAt(carom_last_error());
            throw new CaromException(status, cause == null ? message : cause.Message, cause);
        }

        static string TextAt(IntPtr text)
        {
            int length = 0;
            while (Marshal.ReadByte(text, length) != 0) length++;
            var bytes = new byte[length];
            Marshal.Copy(text, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }

        /// <summary>Returns a text in the form that the library reads.</summary>
        internal static byte[] Text(string text) { return Encoding.UTF8.GetBytes(text + "\0"); }

        /// <summary>Returns texts in the form that the library reads.</summary>
        internal sealed class Texts : IDisposable
        {
            internal readonly IntPtr[] Pointers;

            internal Texts(string[] texts)
            {
                Pointers = new IntPtr[texts.Length];
                for (int i = 0; i < texts.Length; i++)
                {
                    var bytes = Text(texts[i]);
                    Pointers[i] = Marshal.AllocHGlobal(bytes.Length);
                    Marshal.Copy(bytes, 0, Pointers[i], bytes.Length);
                }
            }

            internal UIntPtr Count { get { return (UIntPtr)Pointers.Length; } }

            public void Dispose() { foreach (var pointer in Pointers) Marshal.FreeHGlobal(pointer); }
        }

        /// <summary>Returns the number of values of a quantity per sphere.</summary>
        static int Width(CaromQuantity quantity)
        {
            switch (quantity)
            {
                case CaromQuantity.Positions:
                case CaromQuantity.Velocities:
                case CaromQuantity.AngularVelocities:
                case CaromQuantity.AppliedForces:
                    return 3;
                case CaromQuantity.Orientations:
                    return 4;
                default:
                    return 1;
            }
        }

        /// <summary>Returns the number of rows in an array of values.</summary>
        internal static UIntPtr Rows(CaromQuantity quantity, int numbers)
        {
            int width = Width(quantity);
            if (numbers % width != 0) throw new ArgumentException("there are " + width + " numbers for each sphere");
            return (UIntPtr)(numbers / width);
        }

        /// <summary>Reads items of a world or a path into an array.</summary>
        internal delegate CaromStatus Reader<TOwner, TItem>(
            TOwner owner, TItem[] items, UIntPtr stride, UIntPtr capacity, out UIntPtr count);

        /// <summary>Returns all items that a function reads: it is first asked how many there are.</summary>
        internal static TItem[] All<TOwner, TItem>(Reader<TOwner, TItem> read, TOwner owner)
        {
            UIntPtr count;
            Check(read(owner, null, UIntPtr.Zero, UIntPtr.Zero, out count));
            var items = new TItem[(int)count];
            Check(read(owner, items, UIntPtr.Zero, count, out count));
            return items;
        }

        internal static void RequireWidth(CaromQuantity quantity, int width)
        {
            if (Width(quantity) != width) throw new ArgumentException(quantity + " has not " + width + " numbers");
        }

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        delegate void ForceFunction(ref CaromSphereState sphere, double time, out Double3 force, IntPtr data);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        delegate double PotentialFunction(ref CaromSphereState sphere, double time, IntPtr data);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        delegate void DestroyFunction(IntPtr data);

        [StructLayout(LayoutKind.Sequential)]
        struct ForceStructure
        {
            public ForceFunction Force;
            public PotentialFunction PotentialEnergy;
            public IntPtr Data;
            public DestroyFunction Destroy;
        }

        [StructLayout(LayoutKind.Sequential)]
        struct MeshStructure
        {
            public IntPtr Vertices;
            public UIntPtr VertexCount;
            public IntPtr Triangles;
            public UIntPtr TriangleCount;
            public uint OneSided, Reserved;
        }

        /// <summary>Adds a surface of triangles.</summary>
        internal static CaromStatus AddMesh(
            WorldId world, ref CaromCollider collider, Double3[] vertices, uint[] triangles, bool isOneSided,
            out ulong id)
        {
            if (triangles.Length % 3 != 0) throw new ArgumentException("a triangle has three vertices", "triangles");
            // The library reads the arrays during the call.
            GCHandle points = GCHandle.Alloc(vertices, GCHandleType.Pinned);
            GCHandle indices = GCHandle.Alloc(triangles, GCHandleType.Pinned);
            try
            {
                var mesh = new MeshStructure
                {
                    Vertices = points.AddrOfPinnedObject(),
                    VertexCount = (UIntPtr)vertices.Length,
                    Triangles = indices.AddrOfPinnedObject(),
                    TriangleCount = (UIntPtr)(triangles.Length / 3),
                    OneSided = isOneSided ? 1u : 0u,
                };
                return carom_world_add_mesh(world, ref collider, ref mesh, out id);
            }
            finally
            {
                indices.Free();
                points.Free();
            }
        }

        /// <summary>The functions of a force.</summary>
        sealed class Functions
        {
            internal Func<CaromSphereState, double, Double3> Force;
            internal Func<CaromSphereState, double, double> PotentialEnergy;
        }

        // Kept alive as long as the library may call them.
        static readonly ForceFunction forceFunction = OnForce;
        static readonly PotentialFunction potentialFunction = OnPotentialEnergy;
        static readonly DestroyFunction destroyFunction = OnDestroy;

        /// <summary>The exception that a function of a force has thrown; exceptions must not reach the
        /// library.</summary>
        [ThreadStatic] static Exception thrown;

        static Functions FunctionsOf(IntPtr data) { return (Functions)GCHandle.FromIntPtr(data).Target; }

        [MonoPInvokeCallback(typeof(ForceFunction))]
        static void OnForce(ref CaromSphereState sphere, double time, out Double3 force, IntPtr data)
        {
            try
            {
                force = FunctionsOf(data).Force(sphere, time);
            }
            catch (Exception exception)
            {
                // A value that is not finite makes the library refuse the step.
                force = new Double3(double.NaN, double.NaN, double.NaN);
                thrown = exception;
            }
        }

        [MonoPInvokeCallback(typeof(PotentialFunction))]
        static double OnPotentialEnergy(ref CaromSphereState sphere, double time, IntPtr data)
        {
            try
            {
                return FunctionsOf(data).PotentialEnergy(sphere, time);
            }
            catch (Exception exception)
            {
                thrown = exception;
                return double.NaN;
            }
        }

        [MonoPInvokeCallback(typeof(DestroyFunction))]
        static void OnDestroy(IntPtr data) { GCHandle.FromIntPtr(data).Free(); }

        internal static ulong AddForce(
            WorldId world,
            Func<CaromSphereState, double, Double3> force,
            Func<CaromSphereState, double, double> potentialEnergy)
        {
            if (force == null) throw new ArgumentNullException("force");
            var held = GCHandle.Alloc(new Functions { Force = force, PotentialEnergy = potentialEnergy });
            var structure = new ForceStructure
            {
                Force = forceFunction,
                PotentialEnergy = potentialEnergy == null ? null : potentialFunction,
                Data = GCHandle.ToIntPtr(held),
                Destroy = destroyFunction,
            };
            ulong id;
            var status = carom_world_add_force(world, ref structure, out id);
            // Only a force that was added is destroyed.
            if (status != CaromStatus.Ok) held.Free();
            Check(status);
            return id;
        }

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_check_abi(uint version);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern IntPtr carom_last_error();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_new(out WorldId world);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_copy(WorldId world, out WorldId copy);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_free(WorldId world);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_stop(WorldId world, int stop);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_from_scene(
            byte[] name, IntPtr[] overrides, UIntPtr count, out WorldId world);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_from_toml(
            byte[] toml, IntPtr[] overrides, UIntPtr count, out WorldId world);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_add_toml(WorldId world, byte[] toml, out CaromAdded added);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_simulation(WorldId world, byte[] toml);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_step(WorldId world, double dt);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_advance(WorldId world, ulong frames, out ulong taken);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_step_to_next_event(WorldId world, double within);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_time(WorldId world, out double time);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_frame_time(WorldId world, out double frameTime);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_state_hash(WorldId world, out ulong hash);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromSphere carom_sphere();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_add_sphere(WorldId world, ref CaromSphere sphere, out ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_add_spheres(
            WorldId world, [In] CaromSphere[] spheres, UIntPtr stride, UIntPtr count, [Out] ulong[] ids);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_sphere(WorldId world, ulong id, out CaromSphere sphere);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_sphere(WorldId world, ulong id, ref CaromSphere sphere);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_remove_spheres(WorldId world, [In] ulong[] ids, UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_count(WorldId world, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_read(
            WorldId world, CaromQuantity quantity, [Out] double[] values, UIntPtr stride, UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_read(
            WorldId world, CaromQuantity quantity, [Out] Double3[] values, UIntPtr stride, UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_write(
            WorldId world, CaromQuantity quantity, [In] double[] values, UIntPtr stride, UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_write(
            WorldId world, CaromQuantity quantity, [In] Double3[] values, UIntPtr stride, UIntPtr count);
#if UNITY_5_3_OR_NEWER
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_read_f32(
            WorldId world, CaromQuantity quantity, [Out] UnityEngine.Vector3[] values, UIntPtr stride, UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_read_f32(
            WorldId world, CaromQuantity quantity, [Out] UnityEngine.Quaternion[] values, UIntPtr stride, UIntPtr count);
#endif
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromCollider carom_collider();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_add_collider(
            WorldId world, ref CaromCollider collider, out ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        static extern CaromStatus carom_world_add_mesh(
            WorldId world, ref CaromCollider collider, ref MeshStructure mesh, out ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_add_height_field(
            WorldId world, ref CaromCollider collider, [In] double[,] heights, UIntPtr rows, UIntPtr columns,
            out ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_collider(WorldId world, ulong id, out CaromCollider collider);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_collider(
            WorldId world, ulong id, ref CaromCollider collider);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_surface_velocity(
            WorldId world, ulong collider, ref Double3 velocity);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_keyframes(
            WorldId world, ulong collider, [In] CaromKeyframe[] keyframes, UIntPtr count, ref Double3 pivot,
            uint repeats);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_motion(WorldId world, ulong collider, byte[] motion);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_next_pose(
            WorldId world, ulong collider, ref Double3 position, ref Double4 rotation, double dt);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_remove_collider(WorldId world, ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        static extern CaromStatus carom_world_add_force(WorldId world, ref ForceStructure force, out ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_add_gravity(
            WorldId world, ref Double3 acceleration, out ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_add_drag(WorldId world, double coefficient, out ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_remove_force(WorldId world, ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromSpring carom_spring();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_add_spring(WorldId world, ref CaromSpring spring, out ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_spring(WorldId world, ulong id, out CaromSpring spring);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_spring(WorldId world, ulong id, ref CaromSpring spring);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_remove_spring(WorldId world, ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_ids(
            WorldId world, CaromList list, [Out] ulong[] ids, UIntPtr stride, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_impacts(
            WorldId world, [Out] CaromImpact[] impacts, UIntPtr stride, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_impact_groups(
            WorldId world, [Out] CaromImpactGroup[] groups, UIntPtr stride, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_contacts(
            WorldId world, [Out] CaromContact[] contacts, UIntPtr stride, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_next_event_time(WorldId world, double within, out double time);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_time(WorldId world, double time);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_longest_stable_frame(WorldId world, out double longest);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStrike carom_strike();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_strike(WorldId world, ulong sphere, ref CaromStrike strike);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_material_pairs(WorldId world, byte[] toml);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_emitter(WorldId world, ulong id, byte[] toml);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_remove_emitter(WorldId world, ulong id);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_overlaps(
            WorldId world, double tolerance, [Out] CaromOverlap[] overlaps, UIntPtr stride, UIntPtr capacity,
            out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_has_spin(WorldId world, out uint hasSpin);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_report(WorldId world, out CaromReport report);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_work(WorldId world, out CaromStageCounts work);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_contact_account(
            WorldId world, out CaromContactAccount account);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_zone_account(WorldId world, out CaromZoneAccount account);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_totals(WorldId world, out CaromTotals totals);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromQueryFilter carom_query_filter();
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_cast_rays(
            WorldId world, [In] CaromRay[] rays, UIntPtr count, ref CaromQueryFilter filter, [Out] CaromHit[] hits);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_cast_spheres(
            WorldId world, [In] CaromMovingSphere[] spheres, UIntPtr count, ref CaromQueryFilter filter,
            [Out] CaromHit[] hits);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_nearest(
            WorldId world, ref Double3 point, double within, ref CaromQueryFilter filter, out CaromNearBody nearest);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_overlapping(
            WorldId world, ref CaromMovingSphere sphere, ref CaromQueryFilter filter, [Out] CaromNearBody[] bodies,
            UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_sensor_events(
            WorldId world, [Out] CaromSensorEvent[] events, UIntPtr stride, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_well_events(
            WorldId world, [Out] CaromWellEvent[] events, UIntPtr stride, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_triggers(
            WorldId world, [Out] CaromTrigger[] triggers, UIntPtr stride, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_energy_account(
            WorldId world, out CaromEnergyAccount account);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_integration_energy(WorldId world, out double energy);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_groups(
            WorldId world, ulong sphere, uint groups, uint collidesWith);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_user_data(WorldId world, ulong sphere, out ulong userData);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_set_user_data(WorldId world, ulong sphere, ulong userData);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_apply_impulse(
            WorldId world, ulong sphere, ref Double3 impulse);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_apply_impulse_at(
            WorldId world, ulong sphere, ref Double3 impulse, ref Double3 point);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_predict(
            WorldId world, ulong sphere, double horizon, UIntPtr mostImpacts, out PathId path);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_path_free(PathId path);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_path_end(PathId path, out int end, out double time);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_path_at(
            PathId path, double time, out Double3 position, out Double3 velocity);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_path_impacts(
            PathId path, [Out] CaromImpact[] impacts, UIntPtr stride, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_path_legs(
            PathId path, [Out] CaromPathLeg[] legs, UIntPtr stride, UIntPtr capacity, out UIntPtr count);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_snapshot(WorldId world, out SnapshotId snapshot);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_snapshot_into(WorldId world, SnapshotId snapshot);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_world_restore(WorldId world, SnapshotId snapshot);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_snapshot_free(SnapshotId snapshot);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_snapshot_to_bytes(
            SnapshotId snapshot, [Out] byte[] bytes, UIntPtr capacity, out UIntPtr size);
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl)]
        internal static extern CaromStatus carom_snapshot_from_bytes(
            [In] byte[] bytes, UIntPtr size, out SnapshotId snapshot);
    }
}
