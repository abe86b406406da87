// The interface of the page's parts. Each part gets the newest state ten times a second.
import type { Machine, Role, State } from "../api/contract";

export interface Model {
  readonly machine: Machine;
  readonly state: State;
  readonly role: Role;
  readonly isConnected: boolean;
  /** performance.now() of the server's last proof that it is there. */
  readonly contact_ms: number;
  readonly now_ms: number;
}

export interface View {
  readonly element: HTMLElement;
  show(model: Model): void;
}
