// Lists the slowest tests.

/** How many are listed. */
const MOST = 30;

/** @typedef {{ name: string, seconds: number }} Timed */

/**
 * Passes on the events of a test run, and lists the slowest tests before its summary.
 *
 * @param {AsyncIterable<import("node:test/reporters").TestEvent>} events
 */
export async function* withSlowest(events) {
  /** @type {Timed[]} */
  const tests = [];
  let isListed = false;
  for await (const event of events) {
    if (event.type === "test:pass" || event.type === "test:fail") {
      const { name, details } = event.data;
      if (details.type !== "suite") {
        tests.push({ name, seconds: details.duration_ms / 1000 });
      }
    }
    if (isSummary(event) && !isListed) {
      isListed = true;
      yield* slowest(tests).map(told);
    }
    yield event;
  }
}

/**
 * Returns whether this is the first line of the summary.
 *
 * @param {import("node:test/reporters").TestEvent} event
 */
function isSummary(event) {
  return event.type === "test:diagnostic" && /^tests \d+$/.test(event.data.message);
}

/** @param {Timed[]} tests */
function slowest(tests) {
  return tests.sort((a, b) => b.seconds - a.seconds).slice(0, MOST);
}

/**
 * @param {Timed} test
 * @returns {import("node:test/reporters").TestEvent} a separate line in every report
 */
function told({ name, seconds }) {
  const message = `${seconds.toFixed(1).padStart(6)} s  ${name}`;
  return /** @type {any} */ ({ type: "test:diagnostic", data: { nesting: 0, message } });
}
