// Mirrors the interface as elements of the document, for people who do not see the canvas. The
// first button of the page, which a keyboard or a screen reader finds, switches it on.

/** Time between two updates from the interface [ms]. */
const PAUSE = 250;

/** Shortest time between two impacts that are announced [ms]: a sentence is read aloud to its end. */
const SENTENCE = 3000;

/**
 * @typedef {object} Widget a control of the interface, as in `Page.widgets`, in CSS pixels
 * @property {string} id
 * @property {string} role
 * @property {string} label
 * @property {string | null} value
 * @property {[least: number, largest: number] | null} range
 * @property {boolean} disabled
 * @property {boolean} readOnly whether its text cannot be edited
 * @property {number} x
 * @property {number} y
 * @property {number} width
 * @property {number} height
 */

/** Roles of AccessKit that can be pressed, and their kinds in the document. */
const PRESSED = new Map([
  ["Button", "button"],
  ["Link", "button"],
  ["ComboBox", "button"],
  ["MenuItem", "button"],
  ["DisclosureTriangle", "button"],
  ["CheckBox", "checkbox"],
  ["RadioButton", "checkbox"],
]);

/** Tags of elements that are not buttons. */
const TAGS = new Map([
  ["slider", "input"],
  ["number", "input"],
  ["field", "input"],
  ["lines", "textarea"],
  ["text", "div"],
  ["img", "div"],
]);

/**
 * Shows the switch that starts the mirror of a page.
 *
 * @param {import("carom-web").Page} page
 */
export function offerMirror(page) {
  const begin = /** @type {HTMLButtonElement} */ (document.getElementById("mirror-switch"));
  begin.hidden = false;
  nameTheField();
  leadFirstTabTo(begin);
  begin.addEventListener("click", () => {
    begin.hidden = true;
    start(page);
  });
}

/**
 * Leads the first press of Tab to the switch, which stands before the canvas that has the focus for
 * its keys.
 *
 * @param {HTMLElement} begin
 */
function leadFirstTabTo(begin) {
  const lead = (/** @type {KeyboardEvent} */ event) => {
    if (event.key !== "Tab") return;
    removeEventListener("keydown", lead, true);
    const isAtCanvas = ["carom", ""].includes(document.activeElement?.id ?? "");
    if (event.shiftKey || begin.hidden || !isAtCanvas) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    begin.focus();
  };
  addEventListener("keydown", lead, true);
}

/** Names the interface's own text field for virtual keyboards, which has no label. */
function nameTheField() {
  document
    .querySelectorAll("body > input:not([aria-label])")
    .forEach((field) => field.setAttribute("aria-label", "Text for the interface"));
}

/** @param {import("carom-web").Page} page */
function start(page) {
  const mirror = /** @type {HTMLElement} */ (document.getElementById("mirror"));
  const news = /** @type {HTMLElement} */ (document.getElementById("news"));
  const canvas = /** @type {HTMLElement} */ (document.getElementById("carom"));
  mirror.hidden = false;
  // Tab moves through the elements and leaves the page after the last one.
  canvas.tabIndex = -1;
  canvas.setAttribute("aria-hidden", "true");
  /** @type {Map<string, HTMLElement>} */
  let elements = new Map();
  const tell = tellImpacts(page);
  const update = () => {
    elements = show(page, mirror, elements);
    const status = page.status();
    // `undefined` while a frame is being drawn.
    if (status === undefined) return;
    const notices = status.notices.join(" ");
    if (notices !== news.textContent) news.textContent = notices;
    tell(status.watching);
  };
  update();
  setInterval(update, PAUSE);
  mirror.tabIndex = -1;
  mirror.focus();
}

/**
 * Returns a function that tells of impacts while a scene plays: now and then the hardest one since
 * the time before.
 *
 * @param {import("carom-web").Page} page
 * @returns {(watching: { scene: string, time: number, playing: boolean } | null) => void}
 */
function tellImpacts(page) {
  const impacts = /** @type {HTMLElement} */ (document.getElementById("impacts"));
  let scene = "";
  let heardUntil = 0;
  let toldAt = -Infinity;
  return (watching) => {
    if (!watching?.playing || performance.now() - toldAt < SENTENCE) return;
    // A scene may be another one, or start again.
    if (watching.scene !== scene || watching.time < heardUntil) heardUntil = 0;
    scene = watching.scene;
    const impact = page.hardestImpactAfter(heardUntil);
    heardUntil = watching.time;
    if (impact === undefined) return;
    toldAt = performance.now();
    impacts.textContent = impact;
  };
}

/**
 * Updates the elements. Each stays the same as long as its widget exists, so that it keeps the
 * focus.
 *
 * @param {import("carom-web").Page} page
 * @param {HTMLElement} mirror
 * @param {Map<string, HTMLElement>} before elements by the ids of their widgets
 * @returns {Map<string, HTMLElement>}
 */
function show(page, mirror, before) {
  /** @type {Map<string, HTMLElement>} */
  const elements = new Map();
  /** @type {Widget[]} */
  const widgets = page.widgets();
  for (const widget of widgets) {
    const kind = kindOf(widget);
    let element = before.get(widget.id);
    if (element?.dataset.kind !== kind) element = make(page, widget.id, kind);
    describe(element, widget, kind);
    elements.set(widget.id, element);
  }
  // First, because moving an element would take its focus.
  for (const [id, element] of before) {
    if (elements.get(id) === element) continue;
    if (element === document.activeElement) passFocusOn(element, mirror);
    element.remove();
  }
  let place = mirror.firstChild;
  for (const element of elements.values()) {
    if (place === element) {
      place = element.nextSibling;
    } else {
      mirror.insertBefore(element, place);
    }
  }
  return elements;
}

/**
 * Moves the focus from an element that leaves to the next one that takes it, so that Tab continues
 * at the same place.
 *
 * @param {Element} element
 * @param {HTMLElement} mirror
 */
function passFocusOn(element, mirror) {
  let next = element.nextElementSibling;
  while (next instanceof HTMLElement) {
    next.focus();
    if (document.activeElement === next) return;
    next = next.nextElementSibling;
  }
  mirror.focus();
}

/** @param {Widget} widget */
function kindOf({ role, range }) {
  const pressed = PRESSED.get(role);
  if (pressed) return pressed;
  if (role === "Image") return "img";
  if (role === "SpinButton") return "number";
  if (role === "TextInput" || role === "SearchInput") return "field";
  if (role === "MultilineTextInput") return "lines";
  return role === "Slider" && range ? "slider" : "text";
}

/**
 * @param {import("carom-web").Page} page
 * @param {string} id
 * @param {string} kind
 * @returns {HTMLElement}
 */
function make(page, id, kind) {
  const isNumber = kind === "slider" || kind === "number";
  const element = document.createElement(TAGS.get(kind) ?? "button");
  element.dataset.kind = kind;
  if (kind === "field" || kind === "lines") {
    const field = /** @type {HTMLInputElement | HTMLTextAreaElement} */ (element);
    field.addEventListener("input", () => page.setText(id, field.value));
  } else if (isNumber) {
    const field = /** @type {HTMLInputElement} */ (element);
    field.type = kind === "slider" ? "range" : "number";
    field.step = "any";
    field.addEventListener("change", () => setNumber(page, id, field));
    if (kind === "slider") field.addEventListener("input", () => setNumber(page, id, field));
  } else if (kind !== "text") {
    element.setAttribute("role", kind);
    if (kind !== "img") {
      element.addEventListener("click", () => {
        if (element.getAttribute("aria-disabled") !== "true") page.press(id);
      });
    }
  }
  return element;
}

/**
 * @param {import("carom-web").Page} page
 * @param {string} id
 * @param {HTMLInputElement} field
 */
function setNumber(page, id, field) {
  if (!Number.isNaN(field.valueAsNumber)) page.setNumber(id, field.valueAsNumber);
}

/**
 * @param {HTMLElement} element
 * @param {Widget} widget
 * @param {string} kind
 */
function describe(element, widget, kind) {
  const { label, value, range, disabled, readOnly, x, y, width, height } = widget;
  element.style.translate = `${x}px ${y}px`;
  element.style.width = `${width}px`;
  element.style.height = `${height}px`;
  if (kind === "text") {
    const text = value && value !== label ? `${label}: ${value}` : label;
    if (element.textContent !== text) element.textContent = text;
    return;
  }
  const isOn = value === "true";
  const isSwitch = isOn || value === "false";
  const name =
    value && !isSwitch && (kind === "button" || kind === "img") && value !== label
      ? `${label}: ${value}`
      : label;
  element.setAttribute("aria-label", name);
  if (element instanceof HTMLInputElement || element instanceof HTMLTextAreaElement) {
    if (range && element instanceof HTMLInputElement)
      [element.min, element.max] = range.map(String);
    element.readOnly = readOnly || disabled;
    // The value being edited must not be replaced by an older one.
    if (document.activeElement !== element) element.value = value ?? "";
  } else if (kind === "checkbox") {
    element.setAttribute("aria-checked", String(isOn));
  } else if (kind === "button" && isSwitch) {
    element.setAttribute("aria-pressed", String(isOn));
  }
  // Not `disabled`, which would remove the focus.
  if (kind !== "img") element.setAttribute("aria-disabled", String(disabled));
}
