// The two bodies of an impact or a contact.

/** Returns the ids of body 1, a collider or a sphere, and body 2, a sphere. */
export const between = (isCollider, first, second) =>
  isCollider ? { collider: first, sphere: second } : { spheres: [first, second] };
