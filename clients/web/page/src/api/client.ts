// Requests to the server. The browser adds the session's cookie to them.
import type { Accepted, LoadedProgram, Machine, ReportFile, Role } from "./contract";
import { noAnswer, problemOf, type Result } from "./result";

async function request(path: string, options: RequestInit): Promise<Result<Response>> {
  try {
    const response = await fetch(path, { credentials: "same-origin", cache: "no-store", ...options });
    if (response.ok) return { ok: true, value: response };
    return { ok: false, problem: problemOf(response.status, response.statusText, await response.text()) };
  } catch (error) {
    return { ok: false, problem: noAnswer(String(error)) };
  }
}

async function json<T>(path: string, options: RequestInit = {}): Promise<Result<T>> {
  const answer = await request(path, options);
  if (!answer.ok) return answer;
  try {
    return { ok: true, value: (await answer.value.json()) as T };
  } catch (error) {
    return { ok: false, problem: noAnswer(String(error)) };
  }
}

function post(body: unknown, signal?: AbortSignal): RequestInit {
  const options: RequestInit = {
    method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body),
  };
  return signal ? { ...options, signal } : options;
}

export const signIn = (token: string) => json<{ role: Role }>("/api/session", post({ token }));
export const signOut = () => request("/api/session", { method: "DELETE" });
export const session = (signal?: AbortSignal) => json<{ role: Role }>("/api/session", signal ? { signal } : {});
export const machine = () => json<Machine>("/api/machine");
export const reports = () => json<{ files: ReportFile[] }>("/api/reports");
export const mdiLines = () => json<{ lines: { line: string; accepted: boolean }[] }>("/api/mdi");

export const command = (verb: string, body: object = {}, signal?: AbortSignal) =>
  json<Accepted>(`/api/commands/${verb}`, post(body, signal));

export const loadProgram = (name: string, content: Blob) =>
  json<LoadedProgram>(`/api/program?name=${encodeURIComponent(name)}`, {
    method: "POST", headers: { "Content-Type": "text/plain" }, body: content,
  });

export async function programText(): Promise<Result<string>> {
  const answer = await request("/api/program", {});
  return answer.ok ? { ok: true, value: await answer.value.text() } : answer;
}

export async function programPath(most_points: number): Promise<Result<ArrayBuffer>> {
  const answer = await request(`/api/program/path?points=${most_points}`, {});
  return answer.ok ? { ok: true, value: await answer.value.arrayBuffer() } : answer;
}

/** The newest measured surface, as a table x_mm,y_mm,z_mm. */
export async function heights(): Promise<Result<string>> {
  const answer = await request("/api/heights", {});
  return answer.ok ? { ok: true, value: await answer.value.text() } : answer;
}
