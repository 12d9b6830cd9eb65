"""What is asked of a design: free quantities, objectives, limits; over ranges, maps and tolerances."""
