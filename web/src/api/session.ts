// Whether this browser has a valid token. Only the server knows; a 401 tells us it has not.

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
