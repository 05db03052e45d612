// Sounds of impacts, made by WebAudio without any file.

/** Pitch [Hz] and length [s] of a sound for each role. */
const SOUNDS = {
  bumper: { pitch: 520, length: 0.18, wave: "square" },
  slingshot: { pitch: 330, length: 0.14, wave: "square" },
  target: { pitch: 880, length: 0.5, wave: "sine" },
  drain: { pitch: 110, length: 0.9, wave: "sawtooth" },
  flipper: { pitch: 180, length: 0.06, wave: "triangle" },
  wall: { pitch: 240, length: 0.05, wave: "triangle" },
};

/** An impulse that sounds at full loudness [N s]. */
const LOUD = 0.15;

let context;

// Browsers let a page sound after a key or a finger.
for (const event of ["keydown", "pointerdown"]) {
  addEventListener(event, () => (context ??= new AudioContext()), { once: true });
}

/** Plays the sound of a role; the impulse [N s] decides how loud, and 0 is a sound without an impact. */
export function play(role, impulse) {
  if (context === undefined) return;
  const { pitch, length, wave } = SOUNDS[role];
  const now = context.currentTime;
  const loudness = 0.2 * (impulse === 0 ? 1 : Math.min(1, impulse / LOUD));
  const [source, volume] = [new OscillatorNode(context, { type: wave }), new GainNode(context)];
  source.frequency.setValueAtTime(pitch, now);
  source.frequency.exponentialRampToValueAtTime(0.6 * pitch, now + length);
  volume.gain.setValueAtTime(loudness, now);
  volume.gain.exponentialRampToValueAtTime(1e-4, now + length);
  source.connect(volume).connect(context.destination);
  source.start(now);
  source.stop(now + length);
}
