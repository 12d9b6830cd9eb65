"""The renderer: the only matplotlib.  A picture is drawn the first time and moved the next."""
