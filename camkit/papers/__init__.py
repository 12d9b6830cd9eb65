"""What published papers print, beside what is computed."""
