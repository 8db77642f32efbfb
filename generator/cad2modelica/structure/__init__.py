"""What others may rely on in a generated mechanics, and how it differs from an earlier one."""
