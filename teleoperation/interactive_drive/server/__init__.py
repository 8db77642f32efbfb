"""The web server: who may come in, what is streamed, who steers."""
