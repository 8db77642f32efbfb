"""Studies of accuracy: scenes under every knob, what each run errs and what it costs."""
