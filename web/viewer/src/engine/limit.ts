// Thrown by services where a page cannot do what is asked: an ordinary limit with its reason, no defect.
export class Limit extends Error {}
