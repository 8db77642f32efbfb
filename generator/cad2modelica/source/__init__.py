"""What every reader of files from unknown hands needs: XML, limits, units, problems, notes on what is lost."""
