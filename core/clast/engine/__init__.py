"""Engine: assembles the step loop of a scene and runs it."""
