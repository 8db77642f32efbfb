"""Which effects of contact a scene calls for, and what each of them costs, by building and running variants of it."""
