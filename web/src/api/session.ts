// Whether this browser holds a valid token: the server alone knows, and says so with a 401.

type Listener = () => void;

let signedOut = false;
const listeners = new Set<Listener>();

export const session = {
  isSignedOut: () => signedOut,
  signOut: () => {
    signedOut = true;
    for (const listener of listeners) listener();
  },
  subscribe: (listener: Listener) => {
    listeners.add(listener);
    return () => {
      listeners.delete(listener);
    };
  },
};
