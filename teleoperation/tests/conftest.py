"""Here, so that all tests of the folders below find headless_browser.py."""
