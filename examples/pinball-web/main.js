// The game in the page: keys and fingers move the table, steps of one length follow the clock, and the picture shows
// the ball between two steps.

import { Picture } from "./picture.js";
import { play } from "./sound.js";
import { FRAME, roleOf, Table } from "./table.js";

/** Longest time that is caught up with [s]: after a pause the game goes on where it was. */
const LONGEST = 0.1;

/** Keys of the keyboard by what they do. */
const KEYS = {
  ArrowLeft: "left",
  KeyA: "left",
  ArrowRight: "right",
  KeyD: "right",
  Space: "plunger",
  ArrowDown: "plunger",
  Backspace: "back",
};

const text = await (await fetch("../pinball/table.toml")).text();
const table = new Table(text);
const picture = new Picture(document.querySelector("canvas"), table);
const down = { left: false, right: false, plunger: false, back: false };

/** Listens to keys, and to fingers on the buttons of the page. */
function listen() {
  for (const [event, isDown] of Object.entries({ keydown: true, keyup: false })) {
    addEventListener(event, (pressed) => {
      const key = KEYS[pressed.code];
      if (key === undefined) return;
      down[key] = isDown;
      pressed.preventDefault();
    });
  }
  // Keys that are let go elsewhere are not heard.
  addEventListener("blur", () => Object.keys(down).forEach((key) => (down[key] = false)));
  for (const button of document.querySelectorAll("button")) {
    const { key } = button.dataset;
    button.addEventListener("pointerdown", () => (down[key] = true));
    for (const end of ["pointerup", "pointercancel", "pointerleave"]) {
      button.addEventListener(end, () => (down[key] = false));
    }
  }
}

/** Advances the game by a frame. */
function step() {
  if (down.back) table.goBack(3);
  picture.keepPlaces();
  for (const { collider, impulse } of table.step(down)) {
    play(roleOf(collider), impulse);
    picture.flash(collider);
  }
}

/** Shows the score, the balls left, and what to do. */
function write() {
  const show = (id, value) => {
    const element = document.getElementById(id);
    if (element.textContent !== value) element.textContent = value;
  };
  show("score", table.score.toLocaleString("en"));
  show("balls", "\u25cf".repeat(table.balls));
  const waits = table.isBallWaiting && table.pull === 0;
  const goal =
    table.balls === 0 ? "Game over: hold Space for a new game" : "Hold Space, and let go";
  show("message", waits ? goal : "");
}

let [last, owed] = [performance.now(), 0];

function frame(now) {
  owed = Math.min(owed + (now - last) / 1000, LONGEST);
  last = now;
  for (; owed >= FRAME; owed -= FRAME) step();
  write();
  picture.draw(owed / FRAME, table.pull);
  requestAnimationFrame(frame);
}

listen();
requestAnimationFrame(frame);
