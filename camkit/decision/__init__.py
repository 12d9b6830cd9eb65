"""From many designs to one: the analytic hierarchy process, choosers, summaries."""
