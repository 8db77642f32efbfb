"""The viewer and the plots of all pages: scripts that set-up fetches and bundles."""
