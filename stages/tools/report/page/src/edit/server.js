// SPDX-License-Identifier: GPL-3.0-or-later
// `make view` as seen from the page: the work folder behind http://127.0.0.1. Every request that changes something carries a header
// that a page of another origin cannot send without asking first.

const kChanging = { "X-Roomcut": "1" };

/** The server that serves this page, or null: opened from disk, or served by something else. */
export async function findServer() {
  if (!/^https?:$/.test(window.location.protocol)) {
    return null;
  }
  try {
    const answer = await fetch("api/status");
    return answer.ok ? new Server(await answer.json()) : null;
  } catch {
    return null;
  }
}

class Server {
  constructor(status) {
    this.status = status;
  }

  /** The edit that is in force, as GeoJSON; null when there is none. */
  async edit() {
    if (!this.status.edit) {
      return null;
    }
    const answer = await fetch("api/edit");
    return answer.ok ? answer.json() : null;
  }

  /** @returns {Promise<{accepted?: boolean, changes?: string[], problems?: string[]}>} */
  async save(text) {
    const answer = await fetch("api/edit", { method: "PUT", headers: { ...kChanging, "Content-Type": "application/geo+json" }, body: text });
    return answerOf(answer);
  }

  /** Moves the edit aside. */
  async drop() {
    return answerOf(await fetch("api/edit", { method: "DELETE", headers: kChanging }));
  }

  /** Starts make run. */
  async run() {
    return answerOf(await fetch("api/run", { method: "POST", headers: kChanging }));
  }

  /** @returns {Promise<{running: boolean, stage: ?string, done: number, of: number, log: string[], exit: ?number}>} */
  async progress() {
    return (await fetch("api/run")).json();
  }
}

async function answerOf(answer) {
  let body = {};
  try {
    body = await answer.json();
  } catch {
    // An answer without a body, or not from roomcut.
  }
  return answer.ok ? body : { problems: body.problems ?? [body.error ?? `the server answers ${answer.status} ${answer.statusText}`] };
}
