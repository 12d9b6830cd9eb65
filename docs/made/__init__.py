"""What the pages of the site show beside their texts: asked of the package, of its notebooks and of its tests."""
