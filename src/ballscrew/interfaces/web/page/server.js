// Requests to the server. What is superseded is aborted; what is refused comes as a problem with its faults.

export class Problem extends Error {
  constructor(document) {
    super(document.title);
    this.faults = document.faults ?? [];
    this.lines = document.lines?.length ? document.lines : [document.title];
  }
}

async function checked(response) {
  if (response.ok) return response;
  let document = { title: `The server answered ${response.status}` };
  try { document = await response.json(); } catch { /* no JSON: the status says it */ }
  throw new Problem(document);
}

export async function get(address) { return (await checked(await fetch(`/api/v1/${address}`))).json(); }

export async function send(address, body, signal) {
  const response = await fetch(`/api/v1/${address}`, {
    method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body), signal,
  });
  return checked(response);
}

export async function ask(address, body, signal) { return (await send(address, body, signal)).json(); }
